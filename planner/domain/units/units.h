#pragma once

#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "planner/base/input_files/document.h"
#include "planner/geometry/coordinates.h"

namespace assay::domain {

// What a number measures. Numbers in the program are in SI units: metres, radians, seconds,
// newtons.
enum class Dimension { kRatio, kLength, kAngle, kSpeed, kAngularSpeed, kForce };

// A unit of length, angle, force, or another quantity.
struct Unit {
  std::string_view name;  // text beside a number; empty for a ratio
  double factor = 1;      // size of the unit in SI: metres, radians, newtons, ...
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

// Returns the SI unit of a dimension. Files name a dimension by the name of this unit.
constexpr Unit SiUnitOf(Dimension dimension) {
  switch (dimension) {
    case Dimension::kRatio:
      return kRatio;
    case Dimension::kLength:
      return kMetres;
    case Dimension::kAngle:
      return kRadians;
    case Dimension::kSpeed:
      return {"m/s"};
    case Dimension::kAngularSpeed:
      return {"rad/s"};
    case Dimension::kForce:
      return kNewtons;
  }
  return kRatio;
}
// Returns the dimension whose SI unit has this name, or nothing if there is none.
std::optional<Dimension> DimensionIn(std::string_view si_unit);

// Returns the unit in which people read numbers of a dimension.
constexpr Unit ShownUnitOf(Dimension dimension) {
  switch (dimension) {
    case Dimension::kLength:
      return kMillimetres;
    case Dimension::kAngle:
      return kDegrees;
    case Dimension::kSpeed:
      return {"mm/s", kMillimetres.factor};
    case Dimension::kAngularSpeed:
      return {"deg/s", kDegrees.factor};
    case Dimension::kRatio:
    case Dimension::kForce:
      break;
  }
  return SiUnitOf(dimension);
}

// Returns a number in units as the file has it: "12.5 mm".
std::string Beside(std::string_view number, const Unit& unit);
// Returns a value given in SI, such as 0.0125, in the unit, to six digits: "12.5 mm".
std::string InUnit(double value, const Unit& unit);

// The units of a file's lengths and angles.
struct Units {
  Unit length = kMetres;
  Unit angle = kRadians;
};

// Reads the name of a unit of length: inch, mm, cm or m.
Unit ReadLengthUnit(const Value& value);

// Reads `units: {length: inch | mm | cm | m, angle: degree | radian}`. Missing units are SI.
Units ReadUnits(const Value& root);

// A range of allowed values, in SI; its high end may be infinite.
struct Range {
  double low = 0;
  double high = 0;
};
inline constexpr Range kAtLeastZero = {0, std::numeric_limits<double>::infinity()};

// Returns whether a value in SI is in the range, up to the rounding of the conversion from its
// unit.
bool IsWithin(double value, const Range& range);
// Returns the range in words: "0 m to 0.01 m", "0 m or more".
std::string InUnit(const Range& range, const Unit& unit);

// Returns a number of units in SI. Throws InputError unless it lies in the range, which the message
// gives in that unit.
double ReadWithin(const Value& value, const Unit& unit, const Range& range);

// Reads a length and returns it in metres. A length outside of -100 m to 100 m is refused: it is a
// mistake, and later computations with it could overflow.
double ReadLength(const Value& value, const Units& units);
// Reads an angle and returns it in radians. It is at most two turns in either direction.
double ReadAngle(const Value& value, const Units& units);

// Read a list of two or of three lengths, in metres.
geometry::Vector2 ReadVector2(const Value& value, const Units& units);
geometry::Vector3 ReadVector3(const Value& value, const Units& units);

// Reads a direction: a list of three numbers, such as [1, 0, 0], or one of +x, -x, +y, -y, +z, -z.
// Returns a unit vector.
geometry::Vector3 ReadDirection(const Value& value);

// Reads `[[x axis], [y axis], [z axis], [position]]`, the form in which Spar's tm lists the columns
// of a transform. The axes must be orthonormal to 1e-6 and right-handed.
geometry::Pose ReadColumns(const Value& value, const Units& units);

}  // namespace assay::domain
