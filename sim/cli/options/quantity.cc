#include "sim/cli/options/quantity.h"

#include <fmt/format.h>

#include <cmath>

namespace assay::cli {
namespace {

constexpr int kDigits = 4;
constexpr double kNothing = 1e-9;  // millimetres or degrees; smaller values count as 0

std::string NumberText(double number) {
  return fmt::format("{:.{}g}", std::abs(number) < kNothing ? 0.0 : number, kDigits);
}

// Returns the nearest number toward zero that has no more digits than are shown.
double TowardZero(double number) {
  if (std::abs(number) < kNothing) return 0;
  const double last_digit = std::pow(10, std::floor(std::log10(std::abs(number))) - kDigits + 1);
  return std::trunc(number / last_digit) * last_digit;
}

}  // namespace

std::string QuantityText(double value, const Unit& unit) {
  return domain::Beside(NumberText(value / unit.factor), unit);
}

std::string RangeText(const Interval& range, const Unit& unit) {
  if (std::isinf(range.low) && std::isinf(range.high)) return "unknown";
  const std::string low = NumberText(range.low / unit.factor);
  const std::string high = NumberText(range.high / unit.factor);
  if (low == high) return high;
  return low == "-" + high ? "+-" + high : fmt::format("{} to {}", low, high);
}

std::string NarrowRangeText(const Interval& range, const Unit& unit) {
  const bool holds_zero = range.low <= 0 && range.high >= 0;
  if (!holds_zero) return RangeText(range, unit);
  return RangeText({TowardZero(range.low / unit.factor), TowardZero(range.high / unit.factor)},
                   {unit.name});
}

}  // namespace assay::cli
