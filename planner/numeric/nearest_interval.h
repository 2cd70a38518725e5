#pragma once

#include <algorithm>

#include "planner/base/interval.h"

namespace assay::numeric {

// Interval arithmetic with finite ends that are rounded to nearest. It is for evaluations whose
// rounding errors are bounded as a whole (multiaffine_form.h). That bound costs one addition at the
// end, whereas rounding each end outward costs more than the operations themselves.
struct NearestInterval {
  double low = 0;
  double high = 0;

  NearestInterval() = default;
  NearestInterval(double number) : low(number), high(number) {}  // NOLINT: numbers are intervals
  NearestInterval(double low_end, double high_end) : low(low_end), high(high_end) {}

  NearestInterval& operator+=(const NearestInterval& other) {
    low += other.low;
    high += other.high;
    return *this;
  }
};

inline NearestInterval operator+(NearestInterval a, const NearestInterval& b) { return a += b; }

inline NearestInterval operator-(const NearestInterval& a) { return {-a.high, -a.low}; }

inline NearestInterval operator*(double a, const NearestInterval& b) {
  const double first = a * b.low;
  const double second = a * b.high;
  return {std::min(first, second), std::max(first, second)};
}

inline NearestInterval operator*(const NearestInterval& a, const NearestInterval& b) {
  const double ll = a.low * b.low;
  const double lh = a.low * b.high;
  const double hl = a.high * b.low;
  const double hh = a.high * b.high;
  return {std::min(std::min(ll, lh), std::min(hl, hh)),
          std::max(std::max(ll, lh), std::max(hl, hh))};
}

}  // namespace assay::numeric
