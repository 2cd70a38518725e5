#include "sim/cli/options/quantity.h"

#include <fmt/format.h>

#include <cmath>

#include "planner/plan/data/condition_kind.h"

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

Unit UnitOf(const std::string& variable) {
  for (const char* angle : {"theta_", "skew_", "tip_", "twist_", "turn_"}) {
    if (variable.starts_with(angle)) return kAngleUnit;
  }
  return kLengthUnit;
}

Unit UnitOf(const plan::CertifiedPrecondition& precondition) {
  switch (plan::QuantityOf(precondition.condition)) {
    case plan::Quantity::kLength:
      return kLengthUnit;
    case plan::Quantity::kAngle:
      return kAngleUnit;
    case plan::Quantity::kRatio:
      return kRatioUnit;
  }
  return kRatioUnit;
}

Unit UnitOf(check::Unit unit) {
  switch (unit) {
    case check::Unit::kMetre:
      return kLengthUnit;
    case check::Unit::kRadian:
      return kAngleUnit;
    case check::Unit::kNone:
      return kRatioUnit;
  }
  return kRatioUnit;
}

Unit ShownIn(std::string_view unit) {
  if (unit == "m") return kLengthUnit;
  if (unit == "rad") return kAngleUnit;
  if (unit == "m/s") return {"mm/s", kLengthUnit.factor};
  if (unit == "rad/s") return {"deg/s", kAngleUnit.factor};
  return {unit};
}

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
