#include "sim/execution/trial/scheduler.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

namespace assay::execution::scheduler_test {
namespace {

using testing::ElementsAreArray;
using testing::IsEmpty;
using testing::UnorderedElementsAreArray;

constexpr std::size_t kPieces = 40;

std::vector<std::size_t> FirstOf(std::size_t count) {
  std::vector<std::size_t> indices(count);
  std::iota(indices.begin(), indices.end(), std::size_t{0});
  return indices;
}

// Work whose pieces end in an order of their own: every fourth one takes long.
std::size_t Square(std::size_t i) {
  if (i % 4 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  return i * i;
}

class OnThreads : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Scheduler, OnThreads, testing::Values(1, 2, 7));

TEST_P(OnThreads, KeepsEachResultOnceInTheOrderOfTheIndices) {
  Scheduler scheduler(GetParam());
  std::vector<std::size_t> kept;
  scheduler.InOrder(kPieces, Square, [&](std::size_t i, std::size_t result) {
    EXPECT_EQ(result, i * i);
    kept.push_back(i);
  });
  EXPECT_THAT(kept, ElementsAreArray(FirstOf(kPieces)));
  EXPECT_FALSE(scheduler.Ends());
}

TEST_P(OnThreads, KeepsEachResultOnceWhenItIsDone) {
  Scheduler scheduler(GetParam());
  std::vector<std::size_t> kept;
  scheduler.AsDone(kPieces, Square, [&](std::size_t i, std::size_t) { kept.push_back(i); });
  EXPECT_THAT(kept, UnorderedElementsAreArray(FirstOf(kPieces)));
}

// A piece that is done is kept at once, even if an earlier piece is not done yet.
TEST(Scheduler, DoesNotWaitForEarlierPiecesIfNotAsked) {
  Scheduler scheduler(2);
  std::atomic<bool> is_kept = false;
  std::vector<std::size_t> kept;
  scheduler.AsDone(
      2,
      [&](std::size_t i) {
        while (i == 0 && !is_kept) std::this_thread::yield();
        return i;
      },
      [&](std::size_t i, std::size_t) {
        kept.push_back(i);
        is_kept = true;
      });
  EXPECT_THAT(kept, ElementsAreArray({1, 0}));
}

// A renderer belongs to the thread that made it.
TEST_P(OnThreads, BeginsTheFirstPieceOnTheCallingThread) {
  for (int i = 0; i < 50; ++i) {
    Scheduler scheduler(GetParam());
    std::thread::id first;
    scheduler.InOrder(
        kPieces,
        [&](std::size_t index) {
          if (index == 0) first = std::this_thread::get_id();
          return index;
        },
        [](std::size_t, std::size_t) {});
    EXPECT_EQ(first, std::this_thread::get_id());
  }
}

TEST(Scheduler, HasAsManyThreadsAsAsked) {
  constexpr int kThreads = 5;
  Scheduler scheduler(kThreads);
  std::atomic<int> waiting = 0;
  scheduler.InOrder(
      kThreads,
      [&](std::size_t) {
        for (++waiting; waiting < kThreads;) std::this_thread::yield();
        return 0;
      },
      [](std::size_t, int) {});
  EXPECT_EQ(waiting, kThreads);
}

TEST_P(OnThreads, ThrowsTheFirstExceptionAndKeepsWhatWasBeforeIt) {
  Scheduler scheduler(GetParam());
  std::vector<std::size_t> kept;
  std::atomic<std::size_t> begun = 0;
  const auto work = [&](std::size_t i) {
    ++begun;
    if (i == 9) throw std::runtime_error("piece 9");
    return Square(i);
  };
  const auto keep = [&](std::size_t i, std::size_t) { kept.push_back(i); };
  EXPECT_THAT([&] { scheduler.InOrder(1000, work, keep); },
              testing::ThrowsMessage<std::runtime_error>("piece 9"));
  EXPECT_THAT(kept, ElementsAreArray(FirstOf(kept.size())));
  EXPECT_LE(kept.size(), 9u);
  EXPECT_LT(begun, 1000u);
  EXPECT_TRUE(scheduler.Ends());
  EXPECT_FALSE(scheduler.stopped());
}

TEST(Scheduler, KeepsAllThatCameBeforeAnExceptionOnOneThread) {
  Scheduler scheduler(1);
  std::size_t kept = 0;
  const auto work = [](std::size_t i) {
    if (i == 9) throw std::runtime_error("piece 9");
    return i;
  };
  EXPECT_THROW(scheduler.InOrder(kPieces, work, [&](std::size_t, std::size_t) { ++kept; }),
               std::runtime_error);
  EXPECT_EQ(kept, 9u);
}

TEST_P(OnThreads, ThrowsWhatKeepingThrewAndKeepsNothingAfterIt) {
  Scheduler scheduler(GetParam());
  std::size_t kept = 0;
  const auto keep = [&](std::size_t i, std::size_t) {
    if (i == 3) throw std::runtime_error("no room");
    ++kept;
  };
  EXPECT_THROW(scheduler.InOrder(kPieces, Square, keep), std::runtime_error);
  EXPECT_EQ(kept, 3u);
}

TEST_P(OnThreads, StopsAfterTheFirstPieces) {
  std::atomic<bool> stop = false;
  Scheduler scheduler(GetParam(), [&] { return stop.load(); });
  std::vector<std::size_t> kept;
  scheduler.InOrder(1000, Square, [&](std::size_t i, std::size_t) {
    kept.push_back(i);
    if (i == 5) stop = true;
  });
  EXPECT_THAT(kept, ElementsAreArray(FirstOf(kept.size())));
  EXPECT_GE(kept.size(), 6u);
  EXPECT_LT(kept.size(), 1000u);
  EXPECT_TRUE(scheduler.stopped());
}

// A piece that takes long breaks off by throwing anything.
TEST_P(OnThreads, DropsWhatPiecesThrowAfterAStop) {
  std::atomic<bool> stop = false;
  Scheduler scheduler(GetParam(), [&] { return stop.load(); });
  std::vector<std::size_t> kept;
  const auto work = [&](std::size_t i) {
    if (i == 6) stop = true;
    if (scheduler.Ends()) throw 1;
    return i;
  };
  scheduler.InOrder(kPieces, work, [&](std::size_t i, std::size_t) { kept.push_back(i); });
  EXPECT_THAT(kept, testing::Not(testing::Contains(6u)));
}

TEST(Scheduler, BeginsNothingAfterAStop) {
  Scheduler scheduler(2, [] { return true; });
  std::vector<std::size_t> kept;
  scheduler.InOrder(kPieces, Square, [&](std::size_t i, std::size_t) { kept.push_back(i); });
  EXPECT_THAT(kept, IsEmpty());
}

}  // namespace
}  // namespace assay::execution::scheduler_test
