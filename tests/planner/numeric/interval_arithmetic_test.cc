#include "planner/numeric/interval_arithmetic.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "planner/base/random.h"

namespace assay::numeric::interval_arithmetic_test {
namespace {

// The oracle computes with long double, which has 11 bits more than double. Its own rounding is
// 2000 times smaller.
using Real = long double;

constexpr double kTiniest = std::numeric_limits<double>::denorm_min();
constexpr double kLargest = std::numeric_limits<double>::max();

bool Holds(const Interval& a, Real x) { return Real{a.low} <= x && x <= Real{a.high}; }

// Returns whether the interval contains a value of the oracle up to its own rounding error.
bool HoldsNearly(const Interval& a, Real x) {
  const Real slack = std::abs(x) * std::numeric_limits<Real>::epsilon() * 4;
  return Real{a.low} <= x + slack && x - slack <= Real{a.high};
}

double DrawNumber(RandomStream& random) {
  const std::vector<double> special = {0,      1,        -1,    0.5, -3,        kTiniest, -kTiniest,
                                       1e-310, kLargest, 1e300, 1e9, -kLargest, 1e-200};
  if (random.Index(8) == 0) return special[random.Index(static_cast<int>(special.size()))];
  return random.Uniform(-1, 1) * std::pow(10.0, random.Index(13) - 6);
}

Interval DrawInterval(RandomStream& random) {
  const double a = DrawNumber(random);
  if (random.Index(5) == 0) return {a, a};
  const double b = random.Index(3) == 0 ? DrawNumber(random) : a + random.Uniform(0, 7);
  if (random.Index(12) == 0) return {-kInfinity, b};
  if (random.Index(12) == 0) return {b, kInfinity};
  return {std::min(a, b), std::max(a, b)};
}

double DrawWithin(RandomStream& random, const Interval& a) {
  const double low = std::max(a.low, -1e30);
  const double high = std::min(a.high, 1e30);
  if (low > high) return a.low == -kInfinity ? a.high : a.low;
  switch (random.Index(4)) {
    case 0:
      return low;
    case 1:
      return high;
    default:
      return std::clamp(low + random.Uniform() * (high - low), low, high);
  }
}

bool IsProper(const Interval& a) { return a.low <= a.high; }  // false if an end is NaN

TEST(IntervalArithmetic, RoundingMovesToANeighbourOrOneFurther) {
  RandomStream random(1, "rounding");
  for (int i = 0; i < 100'000; ++i) {
    const double r = DrawNumber(random);
    const double next = std::nextafter(r, kInfinity);
    EXPECT_GE(RoundedUp(r), next);
    EXPECT_LE(RoundedUp(r), std::nextafter(next, kInfinity));
    EXPECT_EQ(RoundedDown(r), -RoundedUp(-r));
  }
  EXPECT_EQ(RoundedUp(kInfinity), kInfinity);
  EXPECT_EQ(RoundedUp(kLargest), kInfinity);
  EXPECT_GE(RoundedDown(kInfinity), kLargest * 0.999);
  EXPECT_LE(RoundedDown(kInfinity), kLargest);
  EXPECT_GT(RoundedUp(0), 0);
}

TEST(IntervalArithmetic, HoldsEveryResultOfItsOperands) {
  RandomStream random(2, "containment");
  for (int i = 0; i < 300'000; ++i) {
    const Interval a = DrawInterval(random);
    const Interval b = DrawInterval(random);
    const double x = DrawWithin(random, a);
    const double y = DrawWithin(random, b);
    const auto context = testing::Message() << "[" << a.low << ", " << a.high << "] at " << x
                                            << ", [" << b.low << ", " << b.high << "] at " << y;
    ASSERT_TRUE(HoldsNearly(a + b, Real{x} + y)) << context;
    ASSERT_TRUE(HoldsNearly(a - b, Real{x} - y)) << context;
    ASSERT_TRUE(HoldsNearly(a * b, Real{x} * y)) << context;
    if (y != 0) {
      ASSERT_TRUE(HoldsNearly(a / b, Real{x} / y)) << context;
    }
    ASSERT_TRUE(HoldsNearly(Sin(a), std::sin(Real{x}))) << context;
    ASSERT_TRUE(HoldsNearly(Cos(a), std::cos(Real{x}))) << context;
    if (x >= 0) {
      ASSERT_TRUE(HoldsNearly(Sqrt(a), std::sqrt(Real{x}))) << context;
    }
    ASSERT_TRUE(Holds(Abs(a), std::abs(x))) << context;
    ASSERT_TRUE(Holds(Min(a, b), std::min(x, y))) << context;
    ASSERT_TRUE(Holds(Max(a, b), std::max(x, y))) << context;
    ASSERT_TRUE(Holds(Hull(a, b), x) && Holds(Hull(a, b), y)) << context;
  }
}

TEST(IntervalArithmetic, PowersHoldEveryResult) {
  RandomStream random(3, "powers");
  for (int i = 0; i < 100'000; ++i) {
    const Interval a = DrawInterval(random);
    const double x = DrawWithin(random, a);
    const int n = random.Index(13) - 6;
    if (x == 0 && n < 0) continue;
    Real power = 1;
    for (int k = 0; k < std::abs(n); ++k) power *= x;
    if (n < 0) power = 1 / power;
    const Interval result = Power(a, n);
    const Real slack = std::abs(power) * std::numeric_limits<Real>::epsilon() * 16;
    ASSERT_TRUE(Real{result.low} <= power + slack && power - slack <= Real{result.high})
        << "[" << a.low << ", " << a.high << "]^" << n << " at " << x;
  }
}

TEST(IntervalArithmetic, IsTightToAFewUnits) {
  RandomStream random(4, "tightness");
  constexpr double kUnit = std::numeric_limits<double>::epsilon();
  for (int i = 0; i < 100'000; ++i) {
    const double x = random.Uniform(-3, 3);
    const double y = random.Uniform(0.5, 3);
    EXPECT_LE(Width(Interval{x, x} + Interval{y, y}), 2 * kUnit * std::abs(x + y));
    EXPECT_LE(Width(Interval{x, x} * Interval{y, y}), 4 * kUnit * std::abs(x * y));
    EXPECT_LE(Width(Interval{x, x} / Interval{y, y}), 4 * kUnit * std::abs(x / y));
    EXPECT_LE(Width(Sqrt({y, y})), 4 * kUnit * std::sqrt(y));
    EXPECT_LE(Width(Sin(Interval{x, x})), 8 * kUnit * std::abs(std::sin(x)));
    EXPECT_LE(Width(Cos(Interval{x, x})), 8 * kUnit * std::abs(std::cos(x)));
  }
}

TEST(IntervalArithmetic, SingleNumbersStaySingleWhereTheResultIsExact) {
  RandomStream random(5, "exact");
  for (int i = 0; i < 10'000; ++i) {
    const double x = random.Index(2'000'001) - 1'000'000;
    const double y = (random.Index(2'000'001) - 1'000'000) / 1024.0;
    EXPECT_EQ((Interval{x, x} + Interval{y, y}), (Interval{x + y, x + y}));
    EXPECT_EQ((Interval{x, x} - Interval{y, y}), (Interval{x - y, x - y}));
    EXPECT_EQ((Interval{x, x} * Interval{y, y}), (Interval{x * y, x * y}));
    if (y != 0) {
      EXPECT_EQ((Interval{x * y, x * y} / Interval{y, y}), (Interval{x, x}));
    }
    EXPECT_EQ(Power({x, x}, 2), (Interval{x * x, x * x}));
    EXPECT_EQ(Sqrt({x * x, x * x}), Abs({x, x}));
  }
  EXPECT_EQ(Sin(Interval{0, 0}), (Interval{0, 0}));
  EXPECT_EQ(Cos(Interval{0, 0}), (Interval{1, 1}));
  EXPECT_FALSE(IsSingle(Interval{0.1, 0.1} + Interval{0.2, 0.2}));
  EXPECT_FALSE(IsSingle(Interval{1, 1} / Interval{3, 3}));
}

TEST(IntervalArithmetic, SymmetryLaws) {
  RandomStream random(6, "symmetry");
  for (int i = 0; i < 50'000; ++i) {
    const Interval a = DrawInterval(random);
    const Interval b = DrawInterval(random);
    EXPECT_EQ(a + b, b + a);
    EXPECT_EQ(a * b, b * a);
    EXPECT_EQ(-a * b, -(a * b));
    EXPECT_EQ(a - b, -(b - a));
    EXPECT_EQ(Sin(-a), -Sin(a));
    EXPECT_EQ(Cos(-a), Cos(a));
    EXPECT_EQ(Min(-a, -b), -Max(a, b));
    EXPECT_EQ(Power(-a, 3), -Power(a, 3));
    EXPECT_EQ(Power(-a, 4), Power(a, 4));
  }
}

bool IsInside(const Interval& inner, const Interval& outer) {
  return outer.low <= inner.low && inner.high <= outer.high;
}

TEST(IntervalArithmetic, IsInclusionMonotone) {
  RandomStream random(7, "inclusion");
  const auto draw_part = [&](const Interval& whole) {
    const double x = DrawWithin(random, whole);
    const double y = DrawWithin(random, whole);
    return Interval{std::min(x, y), std::max(x, y)};
  };
  for (int i = 0; i < 100'000; ++i) {
    const Interval a = DrawInterval(random);
    const Interval b = DrawInterval(random);
    const Interval c = draw_part(a);
    const Interval d = draw_part(b);
    EXPECT_TRUE(IsInside(c + d, a + b));
    EXPECT_TRUE(IsInside(c * d, a * b));
    EXPECT_TRUE(IsInside(c / d, a / b));
    EXPECT_TRUE(IsInside(Abs(c), Abs(a)));
    EXPECT_TRUE(IsInside(Sin(c), Sin(a)))
        << c.low << " " << c.high << " " << a.low << " " << a.high;
    EXPECT_TRUE(IsInside(Cos(c), Cos(a)));
    EXPECT_TRUE(IsInside(Power(c, 2), Power(a, 2)));
  }
}

TEST(IntervalArithmetic, WavesHaveTheirExtremaWhereTheyAre) {
  constexpr double kPi = std::numbers::pi;
  RandomStream random(8, "waves");
  for (int i = 0; i < 100'000; ++i) {
    const double low = random.Uniform(-40, 40);
    const Interval a = {low, low + random.Uniform(0, 8)};
    // The cosine has a maximum at every even multiple of pi and a minimum at every odd one.
    const auto holds_point = [&](double phase) {
      return std::floor((a.high - phase) / (2 * kPi)) > std::floor((a.low - phase) / (2 * kPi));
    };
    const double ends_high = std::max(std::cos(a.low), std::cos(a.high));
    const double ends_low = std::min(std::cos(a.low), std::cos(a.high));
    EXPECT_NEAR(Cos(a).high, holds_point(0) ? 1 : ends_high, 1e-15);
    EXPECT_NEAR(Cos(a).low, holds_point(kPi) ? -1 : ends_low, 1e-15);
    const double shifted_high = std::max(std::sin(a.low), std::sin(a.high));
    EXPECT_NEAR(Sin(a).high, holds_point(kPi / 2) ? 1 : shifted_high, 1e-15);
  }
  EXPECT_EQ(Sin(Interval{0, 1e9}), (Interval{-1, 1}));
  EXPECT_EQ(Cos(kWholeLine), (Interval{-1, 1}));
  EXPECT_EQ(Sin(Interval{3, kInfinity}), (Interval{-1, 1}));
  // A single huge number has one sine, which the C library computes.
  EXPECT_TRUE(Contains(Sin(Interval{1e300, 1e300}), std::sin(1e300)));
  EXPECT_LT(Width(Sin(Interval{1e300, 1e300})), 1e-14);
  EXPECT_EQ(Cos(Interval{1e300, std::nextafter(1e300, kInfinity)}), (Interval{-1, 1}));
}

TEST(IntervalArithmetic, OverflowAndUnderflowStayInside) {
  const Interval largest = {kLargest, kLargest};
  EXPECT_EQ((largest + largest).high, kInfinity);
  EXPECT_LE((largest + largest).low, kLargest);
  EXPECT_LE((largest * largest).low, kLargest);
  const Interval tiniest = {kTiniest, kTiniest};
  EXPECT_EQ(tiniest * tiniest, (Interval{0, kTiniest}));
  EXPECT_EQ(tiniest * -tiniest, (Interval{-kTiniest, 0}));
  EXPECT_EQ((Interval{0, 1} * Interval{2, 3}).low, 0);
  EXPECT_EQ((Interval{0, 0} * kWholeLine), (Interval{0, 0}));
  EXPECT_EQ((Interval{0, 0} * Interval{-3, 7}), (Interval{0, 0}));
}

TEST(IntervalArithmetic, InfiniteEnds) {
  const Interval from_one = {1, kInfinity};
  EXPECT_EQ((from_one + from_one), (Interval{2, kInfinity}));
  EXPECT_EQ((from_one - from_one), kWholeLine);
  EXPECT_EQ((from_one / from_one).high, kInfinity);
  EXPECT_LE((from_one / from_one).low, 0);
  EXPECT_EQ((from_one * Interval{0, 1}).low, 0);
  EXPECT_EQ((from_one * Interval{0, 1}).high, kInfinity);
  EXPECT_EQ((Interval{1, 2} / Interval{-1, 1}), kWholeLine);
  EXPECT_EQ((Interval{1, 2} / Interval{0, 1}), kWholeLine);
  const Interval at_infinity = {kInfinity, kInfinity};
  for (const Interval& a : {at_infinity, -at_infinity, kWholeLine, Interval{0, 0}, from_one}) {
    for (const Interval& b : {at_infinity, -at_infinity, kWholeLine, Interval{0, 0}, from_one}) {
      EXPECT_TRUE(IsProper(a + b) && IsProper(a - b) && IsProper(a * b) && IsProper(a / b));
    }
    EXPECT_TRUE(IsProper(Sin(a)) && IsProper(Cos(a)) && IsProper(Sqrt(a)) && IsProper(Abs(a)));
    EXPECT_TRUE(IsProper(Power(a, 2)) && IsProper(Power(a, 3)) && IsProper(Power(a, -3)));
    EXPECT_TRUE(std::isfinite(Midpoint(a)));
  }
}

TEST(IntervalArithmetic, RootsOfWhatIsNotNegative) {
  EXPECT_EQ(Sqrt({-4, 9}), (Interval{0, 3}));
  EXPECT_EQ(Sqrt({-4, -1}), kWholeLine);
  EXPECT_EQ(Sqrt({4, kInfinity}), (Interval{2, kInfinity}));
}

TEST(IntervalArithmetic, MidpointsAreFiniteAndInside) {
  RandomStream random(9, "midpoints");
  for (int i = 0; i < 50'000; ++i) {
    const Interval a = DrawInterval(random);
    EXPECT_TRUE(Contains(a, Midpoint(a)));
    EXPECT_TRUE(std::isfinite(Midpoint(a)));
    EXPECT_GE(Width(a), a.high - a.low);
  }
  EXPECT_EQ(Midpoint(kWholeLine), 0);
  EXPECT_EQ(Midpoint({-kLargest, kLargest}), 0);
  EXPECT_EQ(Midpoint({-3, 5}), 1);
}

}  // namespace
}  // namespace assay::numeric::interval_arithmetic_test
