#include "sim/check/contact_sequences/rank_correlation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "planner/base/random.h"

namespace assay::check::rank_correlation_test {
namespace {

using ::testing::ElementsAre;

using Values = std::vector<double>;

TEST(Ranks, TiesShareTheirMean) {
  EXPECT_THAT(RanksOf(Values{30, 10, 20, 10}), ElementsAre(4, 1.5, 3, 1.5));
  EXPECT_THAT(RanksOf(Values{7, 7, 7}), ElementsAre(2, 2, 2));
}

// Without ties, Spearman's formula gives 1 - 6 sum d^2 / (n (n^2 - 1)).
TEST(RankCorrelation, WithoutTiesIsSpearmansFormula) {
  RandomStream random(1, "permutations");
  for (int round = 0; round < 200; ++round) {
    const int n = 2 + random.Index(20);
    Values x;
    Values y;
    for (int i = 0; i < n; ++i) {
      x.push_back(random.Uniform());
      y.push_back(random.Uniform());
    }
    double squares = 0;
    for (int i = 0; i < n; ++i) {
      int before = 0;  // rank in x less rank in y
      for (int k = 0; k < n; ++k) before += (x[k] < x[i] ? 1 : 0) - (y[k] < y[i] ? 1 : 0);
      squares += before * before;
    }
    EXPECT_NEAR(*RankCorrelation(x, y), 1 - 6 * squares / (n * (n * n - 1.0)), 1e-12);
  }
}

// Ranks 1.5 1.5 3.5 3.5 are correlated with 1 2 3 4. Their covariance is 4, and their sums of
// squares are 4 and 5.
TEST(RankCorrelation, WithTiesIsPearsonsOfRanks) {
  EXPECT_NEAR(*RankCorrelation(Values{0, 0, 1, 1}, Values{1, 2, 3, 4}), 4 / std::sqrt(4.0 * 5.0),
              1e-12);
}

TEST(RankCorrelation, DependsOnTheOrderAlone) {
  const Values x = {3, 1, 2, 2, 9};
  const Values y = {1, 0, 0, 5, 4};
  Values grown;
  Values mirrored;
  for (const double v : x) {
    grown.push_back(std::exp(v));
    mirrored.push_back(-v);
  }
  EXPECT_NEAR(*RankCorrelation(x, y), *RankCorrelation(y, x), 1e-12);
  EXPECT_NEAR(*RankCorrelation(grown, y), *RankCorrelation(x, y), 1e-12);
  EXPECT_NEAR(*RankCorrelation(mirrored, y), -*RankCorrelation(x, y), 1e-12);
  EXPECT_NEAR(*RankCorrelation(x, x), 1, 1e-12);
}

TEST(RankCorrelation, NeedsVariation) {
  EXPECT_EQ(RankCorrelation(Values{1, 2, 3}, Values{0, 0, 0}), std::nullopt);
  EXPECT_EQ(RankCorrelation({}, {}), std::nullopt);
}

}  // namespace
}  // namespace assay::check::rank_correlation_test
