#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/base/interval.h"

namespace assay {

// Interval arithmetic with outward rounding. For any real operands within the intervals, the true
// result is within the resulting interval, in spite of floating-point rounding. Each end is moved
// outward after the operation, and the rounding mode is not changed. Ends of + - * / and sqrt,
// which IEEE 754 rounds correctly, move by at most two units in the last place. Ends of sin and
// cos, which the C library rounds to within one unit, move by at most four. Ends may be infinite.
// Zero times infinity counts as zero, because an infinite end stands for arbitrarily large numbers
// and not for one number. No end is ever NaN. An operation on two single numbers is exact where its
// double result is exact. Each end of a sum is exact where its double result is exact.
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr Interval kWholeLine = {-kInfinity, kInfinity};
inline constexpr Interval kOne = {1, 1};

// RoundedUp(r) is a double that is not below any real that rounds to r, and RoundedDown(r) is one
// that is not above any. A sum or product that rounds to +infinity may be any real above the
// largest double, so RoundedDown(+infinity) is near the largest double.
inline double RoundedUp(double r);
inline double RoundedDown(double r);

inline Interval operator-(const Interval& a);
inline Interval operator+(const Interval& a, const Interval& b);
inline Interval operator-(const Interval& a, const Interval& b);
inline Interval operator*(const Interval& a, const Interval& b);
Interval operator/(const Interval& a, const Interval& b);  // returns the whole line if b contains 0
Interval Power(const Interval& a, int n);                  // for n < 0 it is 1 / a^-n; a^0 = 1
Interval Sin(const Interval& a);
Interval Cos(const Interval& a);
// Returns the roots of the non-negative part of a, or the whole line if a has no such part.
Interval Sqrt(const Interval& a);
Interval Abs(const Interval& a);
inline Interval Min(const Interval& a, const Interval& b);
inline Interval Max(const Interval& a, const Interval& b);

inline Interval Hull(const Interval& a, const Interval& b);
inline bool Contains(const Interval& a, double x);
inline bool IsSingle(const Interval& a);
double Width(const Interval& a);     // rounded up
double Midpoint(const Interval& a);  // finite and within a; 0 for the whole line

namespace interval_detail {

inline constexpr double kLargest = std::numeric_limits<double>::max();

// Returns at least half a unit in the last place of r, so that r + Step(r) rounds to another double
// (Rump, Zimmermann, Boldo and Melquiond 2009, "Computing predecessor and successor in rounding to
// nearest").
inline double Step(double r) {
  return std::abs(r) * 0x1.0000000000001p-53 + std::numeric_limits<double>::denorm_min();
}

// Returns a lower bound of a + b. The rounding error of a sum is itself a double, which Knuth's
// two-sum computes.
inline double SumFromBelow(double a, double b) {
  const double sum = a + b;
  const double b_seen = sum - a;
  const double error = (a - (sum - b_seen)) + (b - b_seen);
  if (error >= 0 && error <= kLargest) return sum;
  return RoundedDown(sum);
}

// Returns 0 for NaN. Among products of ends only 0 * infinity gives NaN.
inline double ZeroIfNaN(double r) { return r == r ? r : 0; }

Interval ProductOfSingles(double a, double b);
// Returns the outward-rounded product or quotient of a and b, given its computed ends, of which one
// is 0. A zero end is exact where a factor is 0. Otherwise it stands for a tiny number that
// underflowed.
Interval RoundedFromZeroEnds(const Interval& a, const Interval& b, const Interval& computed);

}  // namespace interval_detail

inline double RoundedUp(double r) {
  const double bounded = r < -interval_detail::kLargest ? -interval_detail::kLargest : r;
  const double up = bounded + interval_detail::Step(bounded);
  return up == up ? up : kInfinity;
}

inline double RoundedDown(double r) { return -RoundedUp(-r); }

inline bool IsSingle(const Interval& a) { return a.low == a.high; }

inline Interval operator-(const Interval& a) { return {0 - a.high, 0 - a.low}; }  // "0 -" avoids -0

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

}  // namespace assay
