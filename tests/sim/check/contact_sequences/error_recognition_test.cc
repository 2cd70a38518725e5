#include "sim/check/contact_sequences/error_recognition.h"

#include <gtest/gtest.h>

namespace assay::check::error_recognition_test {
namespace {

using execution::TrialOutcome;
using finemotion::ContactKind;

const ContactKey kWall = {ContactKind::kVertexFace, 3, 1};
const ContactKey kRim = {ContactKind::kEdgeEdge, 2, 5};

// Returns spans in which the wall is touched from 1 to 2 s and the rim from 1.5 to 3 s.
std::vector<ContactSpan> Spans() {
  return {{0, 0, 1, {}},
          {0, 1, 1.5, {kWall}},
          {1, 1.5, 2, {kWall, kRim}},
          {1, 2, 3, {kRim}},
          {2, 3, 4, {}}};
}

execution::RecognizedContact Made(const ContactKey& key, double time) {
  return {finemotion::Name(key), false, time};
}
execution::RecognizedContact Lost(const ContactKey& key, double time) {
  return {finemotion::Name(key), true, time};
}

execution::ErrorState State(int motion,
                            std::optional<execution::RecognizedContact> recognized = {}) {
  return {.outcome = TrialOutcome::kWrongContact, .motion = motion, .recognized = recognized};
}

TEST(ErrorRecognition, IsRightIfTheContactWasThere) {
  EXPECT_TRUE(IsRight(Made(kWall, 1.2), Spans()));
  EXPECT_FALSE(IsRight(Made(kRim, 1.2), Spans()));
  EXPECT_TRUE(IsRight(Made(kRim, 2.5), Spans()));
  EXPECT_FALSE(IsRight(Made(kWall, 2.5), Spans()));
  EXPECT_TRUE(IsRight(Made(kWall, 2.005), Spans())) << "it has just rebounded";
}

TEST(ErrorRecognition, OfALossIsRightIfItWasNotThere) {
  EXPECT_TRUE(IsRight(Lost(kWall, 2.5), Spans()));
  EXPECT_FALSE(IsRight(Lost(kRim, 2.5), Spans()));
}

TEST(ErrorRecognition, EveryErrorStateOfATrialCounts) {
  execution::StrategyEnd end;
  RecognitionTally tally;
  Count(end, Spans(), true, tally);
  EXPECT_EQ(tally.states, Recognition{}) << "it was done at the first attempt";
  EXPECT_EQ(tally.unwanted, (Recognition{.errors = 1})) << "though something touched";
  end.recovered = {State(0), State(1, Made(kRim, 2.5))};
  end.outcome = TrialOutcome::kWrongContact;
  end.motion = 1;
  end.recognized = Made(kWall, 2.5);
  Count(end, Spans(), true, tally);
  EXPECT_EQ(tally.states, (Recognition{.errors = 3, .named = 2, .right = 1}));
  EXPECT_EQ(tally.unwanted, (Recognition{.errors = 2, .named = 1, .right = 1}))
      << "by the first that has a name";
  EXPECT_EQ(tally.needless, 0);
}

TEST(ErrorRecognition, TheWayInTheCreviceIsLeftOut) {
  execution::StrategyEnd end;
  end.outcome = TrialOutcome::kJammed;
  end.motion = 3;
  RecognitionTally tally;
  Count(end, Spans(), false, tally);
  EXPECT_EQ(tally.states, Recognition{});
}

// The strategy ignores an error state, goes on, and ends in the same state. It counts once.
TEST(ErrorRecognition, WhatWasIgnoredCountsOnce) {
  execution::StrategyEnd end;
  end.ignored = {State(0, Made(kWall, 1.2))};
  end.outcome = TrialOutcome::kTimeout;
  end.motion = 1;
  end.recognized = end.ignored[0].recognized;
  RecognitionTally tally;
  Count(end, Spans(), true, tally);
  EXPECT_EQ(tally.states, (Recognition{.errors = 1, .named = 1, .right = 1}));
  Count(end, Spans(), false, tally);
  EXPECT_EQ(tally.needless, 1);
  EXPECT_EQ(tally.unwanted.errors, 1);
}

}  // namespace
}  // namespace assay::check::error_recognition_test
