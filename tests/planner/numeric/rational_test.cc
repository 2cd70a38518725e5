#include "planner/numeric/rational.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace assay::numeric::rational_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kGreatest = std::numeric_limits<double>::max();
constexpr double kLeast = std::numeric_limits<double>::denorm_min();

TEST(Rational, DoublesAreExact) {
  for (const double value : {0.0, -0.0, 0.1, -3.75, 1e300, 1e-300, kGreatest, -kGreatest, kLeast}) {
    EXPECT_EQ(Rational(value).RoundedUp(), value);
    EXPECT_EQ(Rational(value).RoundedDown(), value);
    EXPECT_EQ(Rational(value).Nearest(), value);
    EXPECT_EQ(Rational(value).Exactly(), value);
  }
  EXPECT_NE(Rational(0.1) + 0.2, Rational(0.3));
}

TEST(Rational, RoundsOutwardByOneDouble) {
  for (const Rational& third : {Rational(1) / 3, Rational(-1) / 3, Rational(1e-310) / 3}) {
    const double up = third.RoundedUp(), down = third.RoundedDown();
    EXPECT_LT(third, Rational(up));
    EXPECT_GT(third, Rational(down));
    EXPECT_EQ(std::nextafter(down, kInfinity), up);
    EXPECT_FALSE(third.Exactly());
    EXPECT_LE(Abs(third - third.Nearest()), (Rational(up) - down) / 2);
  }
}

TEST(Rational, BeyondTheDoubles) {
  const Rational large = Rational(kGreatest) * 2, small = Rational(kLeast) / 2;
  EXPECT_EQ(large.RoundedUp(), kInfinity);
  EXPECT_EQ(large.RoundedDown(), kGreatest);
  EXPECT_EQ((-large).RoundedUp(), -kGreatest);
  EXPECT_EQ((-large).RoundedDown(), -kInfinity);
  EXPECT_EQ(large.Nearest(), kGreatest);
  EXPECT_EQ(small.RoundedUp(), kLeast);
  EXPECT_EQ(small.RoundedDown(), 0);
  EXPECT_EQ((-small).RoundedDown(), -kLeast);
}

TEST(Rational, LowestTerms) {
  const Rational ratio = Rational(6) / -4;
  EXPECT_EQ(ratio.Numerator(), Rational(-3));
  EXPECT_EQ(ratio.Denominator(), Rational(2));
  EXPECT_EQ(ratio.Sign(), -1);
  EXPECT_TRUE((ratio - ratio).IsZero());
  EXPECT_EQ(Rational() + Rational(), Rational(0));
  EXPECT_LT(ratio, Rational(-1));
}

}  // namespace
}  // namespace assay::numeric::rational_test
