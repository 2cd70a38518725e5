#include "planner/domain/units/units.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "planner/geometry/pose.h"

namespace assay::domain {
namespace {

using geometry::Matrix3;
using geometry::Pose;
using geometry::Vector2;
using geometry::Vector3;

constexpr double kLongest = 100;                    // metres
constexpr double kTwoTurns = 4 * std::numbers::pi;  // radians
constexpr double kAxisTolerance = 1e-6;
constexpr double kConversionRounding = 1e-9;  // share of a bound

std::vector<Value> ItemsOf(const Value& value, std::size_t count, const std::string& allowed) {
  std::vector<Value> items = value.Items();
  if (items.size() != count) {
    value.Fail(fmt::format("a list of length {}", items.size()), allowed);
  }
  return items;
}

Vector3 ReadAxis(const Value& value) {
  const std::vector<double> axis = value.Numbers(3);
  for (const double entry : axis) {
    if (std::abs(entry) <= 1 + kAxisTolerance) continue;
    value.Fail(fmt::format("{} is no component of a unit vector", entry), "numbers from -1 to 1");
  }
  return {axis[0], axis[1], axis[2]};
}

void RequireOrthonormal(const Value& value, const Matrix3& R) {
  const Matrix3 excess = R.transpose() * R - Matrix3::Identity();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) {
      if (std::abs(excess(i, j)) < kAxisTolerance) continue;
      value.Fail(i == j ? fmt::format("axis {} has the length {:.9g}", "xyz"[i], R.col(i).norm())
                        : fmt::format("axes {} and {} are not at right angles: their product is "
                                      "{:.9g}",
                                      "xyz"[j], "xyz"[i], excess(i, j)),
                 "orthonormal axes, to 1e-6");
    }
  }
  if (R.determinant() > 0) return;
  value.Fail("the axes are left-handed", "z = x cross y");
}

}  // namespace

std::optional<Dimension> DimensionIn(std::string_view si_unit) {
  for (const Dimension dimension :
       {Dimension::kRatio, Dimension::kLength, Dimension::kAngle, Dimension::kSpeed,
        Dimension::kAngularSpeed, Dimension::kForce}) {
    if (SiUnitOf(dimension).name == si_unit) return dimension;
  }
  return std::nullopt;
}

std::string Beside(std::string_view number, const Unit& unit) {
  return unit.name.empty() ? std::string(number) : fmt::format("{} {}", number, unit.name);
}

std::string InUnit(double value, const Unit& unit) {
  return Beside(fmt::format("{:.6g}", value / unit.factor), unit);
}

Unit ReadLengthUnit(const Value& value) {
  static const std::vector<std::string> kLengths = {"inch", "mm", "cm", "m"};
  constexpr std::array kLengthUnits = {kInches, kMillimetres, kCentimetres, kMetres};
  return kLengthUnits[static_cast<std::size_t>(value.OneOf(kLengths))];
}

Units ReadUnits(const Value& root) {
  static const std::vector<std::string> kAngles = {"degree", "radian"};
  constexpr std::array kAngleUnits = {kDegrees, kRadians};
  Units units;
  const std::optional<Value> given = root.Find("units");
  if (!given) return units;
  given->AllowOnly({"length", "angle"});
  if (const auto length = given->Find("length")) units.length = ReadLengthUnit(*length);
  if (const auto angle = given->Find("angle")) {
    units.angle = kAngleUnits[static_cast<std::size_t>(angle->OneOf(kAngles))];
  }
  return units;
}

bool IsWithin(double value, const Range& range) {
  return value >= range.low - kConversionRounding * std::abs(range.low) &&
         value <= range.high + kConversionRounding * std::abs(range.high);
}

std::string InUnit(const Range& range, const Unit& unit) {
  const std::string low = InUnit(range.low, unit);
  return std::isinf(range.high) ? low + " or more"
                                : fmt::format("{} to {}", low, InUnit(range.high, unit));
}

double ReadWithin(const Value& value, const Unit& unit, const Range& range) {
  const double converted = value.Number() * unit.factor;
  if (!IsWithin(converted, range)) {
    value.Fail(fmt::format("{} is out of range", Beside(value.Text(), unit)), InUnit(range, unit));
  }
  return converted;
}

double ReadLength(const Value& value, const Units& units) {
  return ReadWithin(value, units.length, {-kLongest, kLongest});
}

double ReadAngle(const Value& value, const Units& units) {
  return ReadWithin(value, units.angle, {-kTwoTurns, kTwoTurns});
}

Vector2 ReadVector2(const Value& value, const Units& units) {
  const auto items = ItemsOf(value, 2, "a list of two lengths");
  return {ReadLength(items[0], units), ReadLength(items[1], units)};
}

Vector3 ReadVector3(const Value& value, const Units& units) {
  const auto items = ItemsOf(value, 3, "a list of three lengths");
  return {ReadLength(items[0], units), ReadLength(items[1], units), ReadLength(items[2], units)};
}

Vector3 ReadDirection(const Value& value) {
  if (value.IsScalar()) {
    const int side = value.OneOf({"+x", "-x", "+y", "-y", "+z", "-z"});
    return (side % 2 == 0 ? 1 : -1) * Vector3::Unit(side / 2);
  }
  const std::vector<double> numbers = value.Numbers(3);
  const Vector3 direction(numbers[0], numbers[1], numbers[2]);
  const double length = direction.stableNorm();
  if (!(length > 1e-6 && length < 1e6)) {
    value.Fail("the vector has no usable direction", "three numbers, such as [1, 0, 0]");
  }
  return direction / length;
}

Pose ReadColumns(const Value& value, const Units& units) {
  const auto columns = ItemsOf(value, 4, "four columns: the axes x, y, z and the position");
  // The axes are read one by one: Eigen's comma initializer aborts if an exception interrupts it.
  Matrix3 R;
  for (int axis = 0; axis < 3; ++axis) R.col(axis) = ReadAxis(columns[axis]);
  RequireOrthonormal(value, R);
  return geometry::PoseFromColumns(R.col(0), R.col(1), R.col(2), ReadVector3(columns[3], units));
}

}  // namespace assay::domain
