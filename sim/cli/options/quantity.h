#pragma once

#include <string>
#include <string_view>

#include "planner/base/interval.h"
#include "planner/domain/problem/units.h"
#include "planner/plan/data/certificate.h"
#include "sim/check/claims/unit.h"

namespace assay::cli {

// Output for people shows lengths in millimetres and angles in degrees.
using domain::Unit;
inline constexpr Unit kLengthUnit = domain::kMillimetres;
inline constexpr Unit kAngleUnit = domain::kDegrees;
inline constexpr Unit kRatioUnit = domain::kRatio;
inline constexpr double kDegree = kAngleUnit.factor;  // radians

// Returns the unit of an error variable. Variables named theta, skew, tip, twist and turn are
// angles, all others lengths.
Unit UnitOf(const std::string& variable);
// Returns the unit of a precondition's bound, limit, margin and gap.
Unit UnitOf(const plan::CertifiedPrecondition& precondition);
// Returns the unit in which a claim's numbers are shown to people.
Unit UnitOf(check::Unit unit);
// Returns the unit in which values in "m", "rad", "m/s" or "rad/s" are shown to people. Any other
// unit is returned as it is.
Unit ShownIn(std::string_view unit);

// Returns the value with its unit: "-23.01 mm".
std::string QuantityText(double value, const Unit& unit);

// Returns the range without its unit: "+-2.794", "0", "-1.2 to 3.4", "unknown".
std::string RangeText(const Interval& range, const Unit& unit);

// Returns the range as RangeText does, but rounded so that the text's range is not wider.
std::string NarrowRangeText(const Interval& range, const Unit& unit);

}  // namespace assay::cli
