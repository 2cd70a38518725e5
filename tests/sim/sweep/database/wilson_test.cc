#include "sim/sweep/database/wilson.h"

#include <gtest/gtest.h>

#include <cmath>

namespace assay::sweep::wilson_test {
namespace {

// The ends of the interval are the rates p whose distance from the observed rate r is z standard
// deviations of p. They are the roots of (r - p)^2 = z^2 p (1 - p) / n.
TEST(WilsonInterval, EndsAreRatesWithTheObservedOneAtTheEdge) {
  const double z = 1.959963984540054;
  for (const int trials : {1, 5, 40, 1000}) {
    for (int successes = 1; successes < trials; successes += 1 + trials / 7) {
      const double rate = static_cast<double>(successes) / trials;
      const Interval interval = WilsonInterval(successes, trials);
      for (const double p : {interval.low, interval.high}) {
        EXPECT_NEAR((rate - p) * (rate - p), z * z * p * (1 - p) / trials, 1e-12);
      }
      EXPECT_LT(interval.low, rate);
      EXPECT_GT(interval.high, rate);
    }
  }
}

TEST(WilsonInterval, AllAndNone) {
  const double z2 = 1.959963984540054 * 1.959963984540054;
  EXPECT_EQ(WilsonInterval(0, 0), (Interval{0, 1}));
  EXPECT_EQ(WilsonInterval(10, 10).high, 1);
  EXPECT_NEAR(WilsonInterval(10, 10).low, 10 / (10 + z2), 1e-12);
  EXPECT_EQ(WilsonInterval(0, 10).low, 0);
  EXPECT_NEAR(WilsonInterval(0, 10).high, z2 / (10 + z2), 1e-12);
}

}  // namespace
}  // namespace assay::sweep::wilson_test
