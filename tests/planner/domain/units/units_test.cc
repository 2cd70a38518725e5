#include "planner/domain/units/units.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "planner/base/input_files/input_error.h"

namespace assay::domain::units_test {
namespace {

constexpr Range kTenth = {-0.1, 0.1};

Value Read(const std::string& text) { return Document::Parse(text, "f.yaml").root(); }

Units UnitsOf(const std::string& length, const std::string& angle) {
  return ReadUnits(Read(fmt::format("units: {{length: {}, angle: {}}}", length, angle)));
}

std::string ErrorOf(const std::string& number, const Unit& unit, const Range& range = kTenth) {
  try {
    ReadWithin(Read(number), unit, range);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

// The lengths 254 mm, 25.4 cm, 0.254 m and 10 inches are equal. Half a turn is 180 degrees.
TEST(Units, AreThoseOfTheFile) {
  EXPECT_DOUBLE_EQ(ReadLength(Read("10"), UnitsOf("inch", "degree")), 0.254);
  EXPECT_DOUBLE_EQ(ReadLength(Read("254"), UnitsOf("mm", "degree")), 0.254);
  EXPECT_DOUBLE_EQ(ReadLength(Read("25.4"), UnitsOf("cm", "degree")), 0.254);
  EXPECT_DOUBLE_EQ(ReadLength(Read("0.254"), UnitsOf("m", "degree")), 0.254);
  EXPECT_DOUBLE_EQ(ReadAngle(Read("180"), UnitsOf("m", "degree")), std::numbers::pi);
  EXPECT_DOUBLE_EQ(ReadAngle(Read("3"), UnitsOf("m", "radian")), 3);
}

TEST(Units, StandBesideTheNumberAndBothLimits) {
  EXPECT_EQ(ErrorOf("0.8", kMetres), "f.yaml:1:1: 0.8 m is out of range; allowed: -0.1 m to 0.1 m");
  EXPECT_EQ(ErrorOf("8e2", kMillimetres),
            "f.yaml:1:1: 8e2 mm is out of range; allowed: -100 mm to 100 mm");
  EXPECT_EQ(ErrorOf("-90", UnitsOf("m", "degree").angle),
            "f.yaml:1:1: -90 deg is out of range; allowed: -5.72958 deg to 5.72958 deg");
  EXPECT_EQ(ErrorOf("7", kRatio), "f.yaml:1:1: 7 is out of range; allowed: -0.1 to 0.1");
  EXPECT_EQ(ErrorOf("100", kMillimetres), "no error");
}

TEST(Units, AreTheSameToReadAndToTell) {
  for (const Unit& unit : {kInches, kMillimetres, kCentimetres, kMetres, kDegrees, kRadians, kRatio,
                           kNewtons, kKilograms, kKilogramsPerCubicMetre, kSeconds}) {
    const double value = ReadWithin(Read("0.0125"), unit, kAtLeastZero);
    EXPECT_EQ(InUnit(value, unit), Beside("0.0125", unit));
    EXPECT_EQ(Beside("", unit).empty(), unit.name.empty());
  }
}

TEST(Units, AlsoStandBesideARangeWithoutEnd) {
  EXPECT_EQ(ErrorOf("-1", kMetres, kAtLeastZero),
            "f.yaml:1:1: -1 m is out of range; allowed: 0 m or more");
  EXPECT_EQ(ErrorOf("-1e-300", kInches, kAtLeastZero),
            "f.yaml:1:1: -1e-300 inch is out of range; allowed: 0 inch or more");
  EXPECT_EQ(ErrorOf("0", kMetres, kAtLeastZero), "no error");
  EXPECT_EQ(ErrorOf("1e300", kMetres, kAtLeastZero), "no error");
}

// Rounding moves no limit: the greatest allowed number of units is within the range, and a
// millionth more is not.
TEST(Units, ReachUpToTheLimits) {
  for (const Unit& unit : {kInches, kMillimetres, kCentimetres, kMetres, kDegrees, kRadians}) {
    for (const double limit : {1.0, 3.0, 7.0, 12.7, 90.0, 360.0}) {
      const Range range = {-limit * unit.factor, limit * unit.factor};
      EXPECT_EQ(ErrorOf(fmt::format("{}", limit), unit, range), "no error");
      EXPECT_EQ(ErrorOf(fmt::format("{}", -limit), unit, range), "no error");
      EXPECT_NE(ErrorOf(fmt::format("{}", 1.000001 * limit), unit, range), "no error");
    }
  }
}

// Files name a dimension by its SI unit, in which numbers need no conversion.
TEST(Units, OfADimensionNameIt) {
  for (const Dimension dimension :
       {Dimension::kRatio, Dimension::kLength, Dimension::kAngle, Dimension::kSpeed,
        Dimension::kAngularSpeed, Dimension::kForce}) {
    const Unit si = SiUnitOf(dimension);
    EXPECT_EQ(si.factor, 1);
    EXPECT_EQ(DimensionIn(si.name), dimension);
  }
  EXPECT_EQ(DimensionIn("inch"), std::nullopt);
  EXPECT_EQ(InUnit(0.0125, ShownUnitOf(Dimension::kLength)), "12.5 mm");
  EXPECT_EQ(InUnit(std::numbers::pi, ShownUnitOf(Dimension::kAngularSpeed)), "180 deg/s");
  EXPECT_EQ(InUnit(2, ShownUnitOf(Dimension::kRatio)), "2");
}

}  // namespace
}  // namespace assay::domain::units_test
