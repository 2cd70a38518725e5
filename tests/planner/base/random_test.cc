#include "planner/base/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace assay::random_test {
namespace {

constexpr std::uint64_t kSeed = 7;

// SplitMix64 (Steele, Lea and Flood 2014) with the constants of Stafford's mix 13.
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t state) : state_(state) {}

  std::uint64_t Next() {
    state_ += 0x9e3779b97f4a7c15ULL;
    return Mix(state_);
  }

  static std::uint64_t Mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }

 private:
  std::uint64_t state_;
};

std::uint64_t Fnv1a(std::string_view text) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 1099511628211ULL;
  }
  return hash;
}

// The values are those of Rosetta Code, "Pseudo-random numbers/Splitmix64", for the state 1234567.
TEST(RandomStreamTest, TheOracleGivesThePublishedSequence) {
  SplitMix64 oracle(1234567);
  for (std::uint64_t expected :
       {6457827717110365317ULL, 3203168211198807973ULL, 9817491932198370423ULL,
        4593380528125082431ULL, 16408922859458223821ULL}) {
    EXPECT_EQ(oracle.Next(), expected);
  }
}

// The values are reference values of FNV-1a with 64 bits (Fowler, Noll and Vo).
TEST(RandomStreamTest, TheHashOfTheOracleGivesThePublishedValues) {
  EXPECT_EQ(Fnv1a(""), 0xcbf29ce484222325ULL);
  EXPECT_EQ(Fnv1a("a"), 0xaf63dc4c8601ec8cULL);
  EXPECT_EQ(Fnv1a("foobar"), 0x85944171f73967e8ULL);
}

TEST(RandomStreamTest, IsSplitMix64FromSeedAndName) {
  for (std::uint64_t seed : {0ULL, 1ULL, 42ULL, ~0ULL}) {
    for (std::string name : {"", "noise", "trial 3"}) {
      RandomStream stream(seed, name);
      SplitMix64 oracle(SplitMix64::Mix(seed) ^ Fnv1a(name));
      for (int i = 0; i < 100; ++i) ASSERT_EQ(stream.Next(), oracle.Next()) << seed << name << i;
    }
  }
}

TEST(RandomStreamTest, IsTheSameForTheSameSeedAndName) {
  RandomStream a(kSeed, "noise"), b(kSeed, "noise");
  for (int i = 0; i < 1000; ++i) {
    ASSERT_EQ(a.Next(), b.Next());
    ASSERT_EQ(a.Uniform(), b.Uniform());
    ASSERT_EQ(a.Index(10), b.Index(10));
  }
}

TEST(RandomStreamTest, DiffersBySeedAndByName) {
  std::set<std::uint64_t> first;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    for (std::string name : {"a", "b", "ab", "ba", ""})
      first.insert(RandomStream(seed, name).Next());
  }
  EXPECT_EQ(first.size(), 500u);
}

// If the streams are independent, the correlation of n pairs has the standard deviation 1 /
// sqrt(n).
TEST(RandomStreamTest, StreamsWithOtherNamesAreUncorrelated) {
  constexpr int kDraws = 10000;
  RandomStream a(kSeed, "part 1"), b(kSeed, "part 2");
  double sum = 0;
  for (int i = 0; i < kDraws; ++i) sum += (a.Uniform() - 0.5) * (b.Uniform() - 0.5);
  EXPECT_LT(std::abs(sum / kDraws * 12), 4 / std::sqrt(kDraws)) << "seed " << kSeed;
}

TEST(UniformTest, FillsTheHalfOpenInterval) {
  constexpr int kDraws = 100000;
  RandomStream random(kSeed, "uniform");
  double sum = 0, squares = 0, least = 1, greatest = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.Uniform();
    ASSERT_GE(x, 0.0);
    ASSERT_LT(x, 1.0);
    sum += x;
    squares += x * x;
    least = std::min(least, x);
    greatest = std::max(greatest, x);
  }
  EXPECT_NEAR(sum / kDraws, 0.5, 4 * std::sqrt(1.0 / 12 / kDraws)) << "seed " << kSeed;
  EXPECT_NEAR(squares / kDraws, 1.0 / 3, 4 * std::sqrt(4.0 / 45 / kDraws)) << "seed " << kSeed;
  EXPECT_LT(least, 1e-3);
  EXPECT_GT(greatest, 1 - 1e-3);
}

TEST(UniformTest, ScalesToAnyInterval) {
  constexpr int kDraws = 20000;
  RandomStream random(kSeed, "interval");
  double sum = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.Uniform(-3, 5);
    ASSERT_GE(x, -3.0);
    ASSERT_LT(x, 5.0);
    sum += x;
  }
  EXPECT_NEAR(sum / kDraws, 1.0, 4 * 8 * std::sqrt(1.0 / 12 / kDraws)) << "seed " << kSeed;
  EXPECT_EQ(random.Uniform(2, 2), 2.0);
}

class IndexTest : public testing::TestWithParam<int> {};

// The chi-square statistic is compared with its value for the uniform law. The bound is the mean
// plus five standard deviations of the statistic with count - 1 degrees of freedom.
TEST_P(IndexTest, IsUnbiased) {
  const int count = GetParam();
  const int draws = 1000 * count;
  RandomStream random(kSeed, "index");
  std::vector<int> seen(static_cast<std::size_t>(count));
  for (int i = 0; i < draws; ++i) {
    const int index = random.Index(count);
    ASSERT_TRUE(0 <= index && index < count);
    ++seen[static_cast<std::size_t>(index)];
  }
  double statistic = 0;
  for (int n : seen) statistic += (n - 1000.0) * (n - 1000.0) / 1000.0;
  const double freedom = count - 1;
  EXPECT_LE(statistic, freedom + 5 * std::sqrt(2 * freedom)) << "seed " << kSeed;
}

INSTANTIATE_TEST_SUITE_P(Counts, IndexTest, testing::Values(1, 2, 3, 6, 7, 10, 64, 100));

TEST(IndexTest, ReachesLargeCounts) {
  RandomStream random(kSeed, "large");
  constexpr int kCount = 2147483647;
  int high = 0;
  for (int i = 0; i < 1000; ++i) {
    const int index = random.Index(kCount);
    ASSERT_TRUE(0 <= index && index < kCount);
    high += index > kCount / 2 ? 1 : 0;
  }
  EXPECT_NEAR(high, 500, 4 * std::sqrt(250.0)) << "seed " << kSeed;
}

TEST(IndexDeathTest, NeedsACount) {
  RandomStream random(kSeed, "none");
  EXPECT_DEATH(random.Index(0), "broken invariant: count > 0");
}

}  // namespace
}  // namespace assay::random_test
