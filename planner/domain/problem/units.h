#pragma once

#include <limits>
#include <numbers>
#include <string>
#include <string_view>

#include "planner/base/document/document.h"
#include "planner/geometry/pose.h"

namespace assay::domain {

// A unit of length, angle, force, ...
struct Unit {
  std::string_view name;  // as it stands beside a number; of a ratio: empty
  double factor = 1;      // one of it in SI: metres, radians, newtons, ...
};
inline constexpr Unit kInches = {"inch", 0.0254};
inline constexpr Unit kMillimetres = {"mm", 0.001};
inline constexpr Unit kCentimetres = {"cm", 0.01};
inline constexpr Unit kMetres = {"m"};
inline constexpr Unit kDegrees = {"deg", std::numbers::pi / 180};
inline constexpr Unit kRadians = {"rad"};
inline constexpr Unit kRatio = {""};
inline constexpr Unit kNewtons = {"N"};
inline constexpr Unit kKilograms = {"kg"};
inline constexpr Unit kKilogramsPerCubicMetre = {"kg/m^3"};
inline constexpr Unit kSeconds = {"s"};

// "12.5 mm": a number of units, as the file has it.
std::string Beside(std::string_view number, const Unit& unit);
// "12.5 mm", of 0.0125: what is given in SI, in the unit, to six digits.
std::string InUnit(double value, const Unit& unit);

// Units of a file's lengths and angles.
struct Units {
  Unit length = kMetres;
  Unit angle = kRadians;
};

// Reads `units: {length: inch | mm | cm | m, angle: degree | radian}`; SI where it is left out.
Units ReadUnits(const Value& root);

// A range of allowed values, in SI; its high end may be infinite.
struct Range {
  double low = 0;
  double high = 0;
};
inline constexpr Range kAtLeastZero = {0, std::numeric_limits<double>::infinity()};

// Whether a value in SI is in the range, but for what the conversion from its unit rounds.
bool IsWithin(double value, const Range& range);
// "0 m to 0.01 m", "0 m or more".
std::string InUnit(const Range& range, const Unit& unit);

// A number of units, in SI; an InputError unless it lies in the range, which the message tells in
// that unit.
double ReadWithin(const Value& value, const Unit& unit, const Range& range);

// A length in metres, at most 100 m either way: what is longer is a slip, and would overflow later.
double ReadLength(const Value& value, const Units& units);
// An angle in radians, at most two turns either way.
double ReadAngle(const Value& value, const Units& units);

// A list of two or of three lengths, in metres.
geometry::Vector2 ReadVector2(const Value& value, const Units& units);
geometry::Vector3 ReadVector3(const Value& value, const Units& units);

// `[[x axis], [y axis], [z axis], [position]]`, as Spar's tm lists the columns of a transform. The
// axes must be orthonormal to 1e-6 and right-handed.
geometry::Pose ReadColumns(const Value& value, const Units& units);

}  // namespace assay::domain
