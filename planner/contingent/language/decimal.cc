#include "planner/contingent/language/decimal.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace assay::contingent {
namespace {

constexpr double kUnits = 1e9;  // the number of decimal units in the number one
// With this limit a product with kUnits is off by less than half a unit, and different decimals are
// different doubles.
constexpr double kMostUnits = 1e15;

struct Decimal {
  std::int64_t units = 0;
  // true if the double equals the decimal exactly, and is not only the nearest double
  bool is_binary = false;
};

std::optional<Decimal> DecimalOf(double number) {
  const double units = std::round(number * kUnits);
  if (!(std::abs(units) <= kMostUnits) || units / kUnits != number) return std::nullopt;
  return Decimal{static_cast<std::int64_t>(units), std::fma(number, kUnits, -units) == 0};
}

// Returns true if `sum` is the exact sum of the doubles `a` and `b` (Knuth's TwoSum).
bool IsExact(double a, double b, double sum) {
  const double b_of_sum = sum - a;
  return (a - (sum - b_of_sum)) + (b - b_of_sum) == 0;
}

// Returns the greatest rounding error of the sum of two doubles. The bound also holds if the
// doubles were read from decimal numbers, which they may not represent exactly.
double ErrorOf(double a, double b) {
  return 2 * std::numeric_limits<double>::epsilon() * (std::abs(a) + std::abs(b));
}

double LeastSum(double a, double b) {
  const double sum = a + b;
  return ExactSum(a, b).value_or(std::isinf(sum) ? sum : sum - ErrorOf(a, b));
}

}  // namespace

std::optional<double> ExactSum(double a, double b) {
  const std::optional<Decimal> first = DecimalOf(a);
  const std::optional<Decimal> second = DecimalOf(b);
  if (first && second) {
    const double sum = static_cast<double>(first->units + second->units) / kUnits;
    if (DecimalOf(sum)) return sum;
  }
  const bool are_binary = (!first || first->is_binary) && (!second || second->is_binary);
  const double sum = a + b;
  if (!are_binary || !std::isfinite(sum) || !IsExact(a, b, sum)) return std::nullopt;
  return sum;
}

Interval EnclosingSum(const Interval& a, const Interval& b) {
  // subtracting from 0 never gives -0
  return {LeastSum(a.low, b.low), 0 - LeastSum(-a.high, -b.high)};
}

double WidthOf(double low, double high) { return 0 - LeastSum(low, -high); }

}  // namespace assay::contingent
