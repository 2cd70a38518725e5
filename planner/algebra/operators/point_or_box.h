#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {

// Operations that mean the same for doubles (values at a point) and for intervals (values over a
// box), so that one rule serves both.

template <class Number>
Number Exactly(double x) {
  if constexpr (std::is_same_v<Number, double>) {
    return x;
  } else {
    return {x, x};
  }
}

inline double Low(double a) { return a; }
inline double Low(const Interval& a) { return a.low; }
inline double High(double a) { return a; }
inline double High(const Interval& a) { return a.high; }
inline bool IsZero(double a) { return a == 0; }
inline bool IsZero(const Interval& a) { return a.low == 0 && a.high == 0; }

// Returns what an operator gives for an unknown or undefined value: NaN, or the whole line.
template <class Number>
Number Unknown() {
  if constexpr (std::is_same_v<Number, double>) {
    return std::numeric_limits<double>::quiet_NaN();
  } else {
    return kWholeLine;
  }
}

// Returns the slope at a place where it may jump from `low` to `high`. Such jumps occur in |a|, min
// and max. As an interval, the result contains the slopes on both sides.
template <class Number>
Number Between(double low, double high) {
  if constexpr (std::is_same_v<Number, double>) {
    return high;
  } else {
    return {low, high};
  }
}

inline double RaisedTo(double a, int n) {
  if (n < 0) return 1 / RaisedTo(a, -n);
  double power = 1;
  for (; n > 0; n /= 2, a *= a) {
    if (n % 2 == 1) power *= a;
  }
  return power;
}
inline Interval RaisedTo(const Interval& a, int n) { return Power(a, n); }

}  // namespace assay::algebra
