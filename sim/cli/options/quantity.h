#pragma once

#include <string>
#include <string_view>

#include "planner/base/interval.h"
#include "planner/domain/problem/units.h"
#include "planner/plan/data/certificate.h"
#include "sim/check/claims/unit.h"

namespace assay::cli {

// Metres are shown to people in millimetres, radians in degrees.
using domain::Unit;
inline constexpr Unit kLengthUnit = domain::kMillimetres;
inline constexpr Unit kAngleUnit = domain::kDegrees;
inline constexpr Unit kRatioUnit = domain::kRatio;
inline constexpr double kDegree = kAngleUnit.factor;  // radians

// Of what an error variable measures: theta, skew, tip, twist and turn are angles, all else
// lengths.
Unit UnitOf(const std::string& variable);
// Of a precondition's bound, limit, margin and gap.
Unit UnitOf(const plan::CertifiedPrecondition& precondition);
// The unit in which people are told the numbers of a claim.
Unit UnitOf(check::Unit unit);
// The unit in which people are told what is in "m", "rad", "m/s" or "rad/s"; any other unit stays
// as it is.
Unit ShownIn(std::string_view unit);

// "-23.01 mm".
std::string QuantityText(double value, const Unit& unit);

// "+-2.794", "0", "-1.2 to 3.4", "unknown": without the unit.
std::string RangeText(const Interval& range, const Unit& unit);

// The same, rounded so that the range in the text is not wider.
std::string NarrowRangeText(const Interval& range, const Unit& unit);

}  // namespace assay::cli
