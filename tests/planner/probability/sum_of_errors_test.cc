#include "planner/probability/sum_of_errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "planner/base/random.h"
#include "tests/planner/probability/drawn.h"

namespace assay::probability::sum_of_errors_test {
namespace {

constexpr std::uint64_t kSeed = 32;

void ExpectContains(const Interval& bounds, double probability) {
  EXPECT_LE(bounds.low, probability);
  EXPECT_GE(bounds.high, probability);
}

TEST(SumOfErrors, OfNothingIsZero) {
  const SumOfErrors sum;
  EXPECT_NEAR(sum.Beyond(-0.1).low, 1, 1e-9);
  EXPECT_EQ(sum.Beyond(0.1).high, 0);
}

TEST(SumOfErrors, OfOneUniformErrorIsALine) {
  SumOfErrors sum;
  sum.Add(-2, Uniform({-1, 3}));  // from -6 to 2
  for (const double limit : {-5.9, -3.0, 0.0, 1.99}) {
    const Interval bounds = sum.Beyond(limit);
    ExpectContains(bounds, (2 - limit) / 8);
    EXPECT_LT(bounds.high - bounds.low, 6e-4);
  }
  EXPECT_EQ(sum.Beyond(2.1).high, sum.Beyond(3).high);
  EXPECT_LT(sum.Beyond(2.1).high, 1e-11);
}

// The sum of n uniform numbers from 0 to 1 has the distribution of Irwin and Hall.
double IrwinHallBeyond(int n, double limit) {
  double below = 0;
  double sign = 1;
  double choose = 1;
  for (int k = 0; k <= static_cast<int>(limit); ++k) {
    below += sign * choose * std::pow(limit - k, n);
    sign = -sign;
    choose = choose * (n - k) / (k + 1);
  }
  return 1 - below / std::tgamma(n + 1);
}

TEST(SumOfErrors, OfUniformErrorsIsTheDistributionOfIrwinAndHall) {
  for (const int n : {2, 3, 6}) {
    SumOfErrors sum;
    for (int i = 0; i < n; ++i) sum.Add(1, Uniform({0, 1}));
    for (const double limit : {0.3, 0.5 * n, 0.8 * n, n - 0.2}) {
      const Interval bounds = sum.Beyond(limit);
      ExpectContains(bounds, IrwinHallBeyond(n, limit));
      EXPECT_LT(bounds.high - bounds.low, 0.01);
    }
  }
}

// Normal distributions add up exactly, however far the tail is.
TEST(SumOfErrors, OfNormalErrorsIsNormal) {
  SumOfErrors sum;
  sum.Add(3, Normal(0.1));
  sum.Add(-4, Normal(0.1));
  sum.AddVariance(0);
  for (const double multiple : {-2.0, 0.0, 3.0, 6.0}) {
    const double exact = 0.5 * std::erfc(multiple / std::sqrt(2.0));
    const Interval bounds = sum.Beyond(multiple * 0.5);
    ExpectContains(bounds, exact);
    EXPECT_LT(bounds.high - bounds.low, 1e-9 * exact);
  }
}

// A normal distribution that is cut off far away is the same as one that is not.
TEST(SumOfErrors, CutOffDistributionsComeCloseToThoseThatAreNot) {
  SumOfErrors whole;
  SumOfErrors cut;
  for (const double factor : {1.0, 2.0, 0.5}) {
    whole.Add(factor, Normal(1));
    cut.Add(factor, NormalWithin(1, {-8, 8}));
  }
  for (const double limit : {0.0, 2.0, 6.0}) {
    const Interval bounds = cut.Beyond(limit);
    ExpectContains(bounds, whole.Beyond(limit).high);
    EXPECT_LT(bounds.high, 1.1 * bounds.low);
  }
}

// Random sums of all kinds of distributions, against samples. A share of samples is within five
// standard deviations of the probability.
TEST(SumOfErrors, BoundsTheShareOfSamples) {
  constexpr int kSamples = 40'000;
  RandomStream random(kSeed, "sums");
  std::mt19937_64 generator(kSeed);
  for (int i = 0; i < 20; ++i) {
    SumOfErrors sum;
    std::vector<std::pair<double, ErrorDistribution>> terms;
    for (int k = 0, count = 1 + random.Index(5); k < count; ++k) {
      const double factor = random.Uniform(-2, 2);
      const double wide = random.Uniform(0.1, 2);
      const int kind = random.Index(3);
      const ErrorDistribution distribution = kind == 0   ? Uniform({-wide, 0.5 * wide})
                                             : kind == 1 ? Normal(wide)
                                                         : NormalWithin(wide, {-wide, 2 * wide});
      terms.emplace_back(factor, distribution);
      sum.Add(factor, distribution);
    }
    const double limit = random.Uniform(-2, 3);
    int beyond = 0;
    for (int sample = 0; sample < kSamples; ++sample) {
      double value = 0;
      for (const auto& [factor, distribution] : terms)
        value += factor * Drawn(distribution, generator);
      beyond += value > limit ? 1 : 0;
    }
    const double share = static_cast<double>(beyond) / kSamples;
    const double tolerance = 5 * std::sqrt(std::max(share * (1 - share), 1e-4) / kSamples);
    const Interval bounds = sum.Beyond(limit);
    EXPECT_LE(bounds.low, share + tolerance) << "seed " << kSeed << ", sum " << i;
    EXPECT_GE(bounds.high, share - tolerance) << "seed " << kSeed << ", sum " << i;
    EXPECT_LT(bounds.high - bounds.low, 0.01);
  }
}

}  // namespace
}  // namespace assay::probability::sum_of_errors_test
