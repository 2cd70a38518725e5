#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/base/interval.h"

namespace assay::algebra {

// Interval arithmetic that is never too narrow: whatever reals stand in the operands, the true
// result stands in the answer, in spite of floating-point rounding. Each end is moved outward after
// the operation (no change of the rounding mode): by at most two units in the last place after
// + - * / and sqrt, which IEEE 754 rounds correctly, and by at most four after sin and cos, which
// the C library rounds to within one. Ends may be infinite; 0 * infinity counts as 0 (the infinite
// end stands for arbitrarily large numbers, not for one). No end is ever NaN. Facts that hold:
// a op b of single numbers is exact where the double result is; so is every end of a sum.
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr Interval kWholeLine = {-kInfinity, kInfinity};
inline constexpr Interval kOne = {1, 1};

// A double at least as large (as small) as any real that rounds to r. A sum or product that rounds
// to +infinity may be any real above the largest double: RoundedDown(+infinity) is near that one.
inline double RoundedUp(double r);
inline double RoundedDown(double r);

inline Interval operator-(const Interval& a);
inline Interval operator+(const Interval& a, const Interval& b);
inline Interval operator-(const Interval& a, const Interval& b);
inline Interval operator*(const Interval& a, const Interval& b);
Interval operator/(const Interval& a, const Interval& b);  // the whole line if b holds 0
Interval Power(const Interval& a, int n);                  // n < 0: 1 / a^-n; a^0 = 1
Interval Sin(const Interval& a);
Interval Cos(const Interval& a);
// Of the part of a that is not negative; the whole line if there is none.
Interval Sqrt(const Interval& a);
Interval Abs(const Interval& a);
inline Interval Min(const Interval& a, const Interval& b);
inline Interval Max(const Interval& a, const Interval& b);

inline Interval Hull(const Interval& a, const Interval& b);
inline bool Contains(const Interval& a, double x);
inline bool IsSingle(const Interval& a);
double Width(const Interval& a);     // rounded up
double Midpoint(const Interval& a);  // finite and in a; 0 for the whole line

namespace interval_detail {

inline constexpr double kLargest = std::numeric_limits<double>::max();

// At least half a unit in the last place of r, so that r + it is rounded to another double (Rump,
// Zimmermann, Boldo and Melquiond 2009, "Computing predecessor and successor in rounding to
// nearest").
inline double Step(double r) {
  return std::abs(r) * 0x1.0000000000001p-53 + std::numeric_limits<double>::denorm_min();
}

// a + b, from below: the rounding error of the sum is itself a double, by Knuth's two-sum.
inline double SumFromBelow(double a, double b) {
  const double sum = a + b;
  const double b_seen = sum - a;
  const double error = (a - (sum - b_seen)) + (b - b_seen);
  if (error >= 0 && error <= kLargest) return sum;
  return RoundedDown(sum);
}

// For the products of ends: only 0 * infinity gives NaN.
inline double ZeroIfNaN(double r) { return r == r ? r : 0; }

Interval ProductOfSingles(double a, double b);
// The product or quotient of a and b from its ends as computed, one of which is 0: that is exact
// where a factor is 0, else a tiny number that vanished.
Interval RoundedFromZeroEnds(const Interval& a, const Interval& b, const Interval& computed);

}  // namespace interval_detail

inline double RoundedUp(double r) {
  const double bounded = r < -interval_detail::kLargest ? -interval_detail::kLargest : r;
  const double up = bounded + interval_detail::Step(bounded);
  return up == up ? up : kInfinity;
}

inline double RoundedDown(double r) { return -RoundedUp(-r); }

inline bool IsSingle(const Interval& a) { return a.low == a.high; }

inline Interval operator-(const Interval& a) { return {0 - a.high, 0 - a.low}; }  // never -0

inline Interval operator+(const Interval& a, const Interval& b) {
  return {interval_detail::SumFromBelow(a.low, b.low),
          0 - interval_detail::SumFromBelow(-a.high, -b.high)};
}

inline Interval operator-(const Interval& a, const Interval& b) { return a + -b; }

inline Interval operator*(const Interval& a, const Interval& b) {
  using interval_detail::ZeroIfNaN;
  if (IsSingle(a) && IsSingle(b)) return interval_detail::ProductOfSingles(a.low, b.low);
  const double ll = ZeroIfNaN(a.low * b.low);
  const double lh = ZeroIfNaN(a.low * b.high);
  const double hl = ZeroIfNaN(a.high * b.low);
  const double hh = ZeroIfNaN(a.high * b.high);
  const double low = std::min(std::min(ll, lh), std::min(hl, hh));
  const double high = std::max(std::max(ll, lh), std::max(hl, hh));
  if (low == 0 || high == 0) return interval_detail::RoundedFromZeroEnds(a, b, {low, high});
  return {RoundedDown(low), RoundedUp(high)};
}

inline Interval Min(const Interval& a, const Interval& b) {
  return {std::min(a.low, b.low), std::min(a.high, b.high)};
}

inline Interval Max(const Interval& a, const Interval& b) {
  return {std::max(a.low, b.low), std::max(a.high, b.high)};
}

inline Interval Hull(const Interval& a, const Interval& b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

inline bool Contains(const Interval& a, double x) { return a.low <= x && x <= a.high; }

}  // namespace assay::algebra
