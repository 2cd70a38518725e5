#pragma once

#include <string>

#include "planner/base/interval.h"
#include "planner/domain/units/units.h"

namespace assay::cli {

// The units of output for people (domain::ShownUnitOf).
using domain::Dimension;
using domain::ShownUnitOf;
using domain::Unit;
inline constexpr Unit kLengthUnit = ShownUnitOf(Dimension::kLength);
inline constexpr Unit kAngleUnit = ShownUnitOf(Dimension::kAngle);
inline constexpr Unit kRatioUnit = ShownUnitOf(Dimension::kRatio);
inline constexpr double kDegree = kAngleUnit.factor;  // radians

// Returns the value with its unit: "-23.01 mm".
std::string QuantityText(double value, const Unit& unit);

// Returns the range without its unit: "+-2.794", "0", "-1.2 to 3.4", "unknown".
std::string RangeText(const Interval& range, const Unit& unit);

// Returns the range as RangeText does, but rounded so that the text's range is not wider.
std::string NarrowRangeText(const Interval& range, const Unit& unit);

}  // namespace assay::cli
