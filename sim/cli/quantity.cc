#include "sim/cli/quantity.h"

#include <fmt/format.h>

#include <cmath>

namespace assay::cli {
namespace {

constexpr int kDigits = 4;
constexpr double kNothing = 1e-9;  // millimetres or degrees: what is below counts as 0

std::string NumberText(double number) {
  return fmt::format("{:.{}g}", std::abs(number) < kNothing ? 0.0 : number, kDigits);
}

// The number next to zero that has no more digits than are shown.
double TowardZero(double number) {
  if (std::abs(number) < kNothing) return 0;
  const double last_digit = std::pow(10, std::floor(std::log10(std::abs(number))) - kDigits + 1);
  return std::trunc(number / last_digit) * last_digit;
}

}  // namespace

Unit UnitOf(const std::string& variable) {
  for (const char* angle : {"theta_", "skew_", "tip_", "twist_", "turn_"}) {
    if (variable.starts_with(angle)) return kAngleUnit;
  }
  return kLengthUnit;
}

Unit UnitOf(const plan::CertifiedPrecondition& precondition) {
  if (precondition.condition == "holding") return kRatioUnit;
  const bool is_angle = precondition.condition == "tilt" || precondition.condition == "tip turn" ||
                        precondition.condition == "reach";
  return is_angle ? kAngleUnit : kLengthUnit;
}

std::string QuantityText(double value, const Unit& unit) {
  const std::string number = NumberText(unit.scale * value);
  return *unit.name == 0 ? number : fmt::format("{} {}", number, unit.name);
}

std::string RangeText(const Interval& range, const Unit& unit) {
  if (std::isinf(range.low) && std::isinf(range.high)) return "unknown";
  const std::string low = NumberText(unit.scale * range.low);
  const std::string high = NumberText(unit.scale * range.high);
  if (low == high) return high;
  return low == "-" + high ? "+-" + high : fmt::format("{} to {}", low, high);
}

std::string NarrowRangeText(const Interval& range, const Unit& unit) {
  const bool holds_zero = range.low <= 0 && range.high >= 0;
  if (!holds_zero) return RangeText(range, unit);
  return RangeText({TowardZero(unit.scale * range.low), TowardZero(unit.scale * range.high)},
                   {unit.name, 1});
}

}  // namespace assay::cli
