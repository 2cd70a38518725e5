#pragma once

#include <numbers>
#include <string>

#include "planner/base/interval.h"
#include "planner/plan/certificate.h"

namespace assay::cli {

// Metres are shown to people in millimetres, radians in degrees.
struct Unit {
  const char* name;
  double scale;  // people's number / SI's
};
inline constexpr Unit kLengthUnit = {"mm", 1000};
inline constexpr Unit kAngleUnit = {"deg", 180 / std::numbers::pi};
inline constexpr Unit kRatioUnit = {"", 1};
inline constexpr double kDegree = std::numbers::pi / 180;  // radians

// Of what an error variable measures: theta, skew, tip, twist and turn are angles, all else
// lengths.
Unit UnitOf(const std::string& variable);
// Of a precondition's bound, limit, margin and gap.
Unit UnitOf(const plan::CertifiedPrecondition& precondition);

// "-23.01 mm".
std::string QuantityText(double value, const Unit& unit);

// "+-2.794", "0", "-1.2 to 3.4", "unknown": without the unit.
std::string RangeText(const Interval& range, const Unit& unit);

// The same, rounded so that the range in the text is not wider.
std::string NarrowRangeText(const Interval& range, const Unit& unit);

}  // namespace assay::cli
