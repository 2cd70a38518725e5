#include "planner/domain/matings/seat.h"

#include <gtest/gtest.h>

#include "planner/geometry/pose.h"
#include "tests/planner/domain/parts.h"

namespace assay::domain::seat_test {
namespace {

// A plate of 20 mm with a square hole of this depth from above.
std::shared_ptr<const PartModel> PlateWithHole(int depth_mm) {
  return ParsePart(
      "format: assay-part/1\nname: plate\ninitial: P\n"
      "units: {length: mm, angle: degree}\ndensity: 1000\nfriction: 0.3\n"
      "solids:\n  plate: {box: [[-30, -30, 0], [30, 30, 20]]}\n"
      "pockets:\n  hole: {cut_from: plate, box: [[-11, -11, " +
      std::to_string(20 - depth_mm) + "], [11, 11, 20]]}\n");
}

std::shared_ptr<const PartModel> Pin() {
  return ParsePart(
      "format: assay-part/1\nname: pin\ninitial: I\nunits: {length: mm, angle: degree}\n"
      "density: 1000\nfriction: 0.3\nsolids:\n  pin: {box: [[-10, -10, 0], [10, 10, 60]]}\n");
}

// Returns the way down of a pin whose tip is at a height over the plate's lower side.
std::optional<double> WayFrom(double height, int depth_mm) {
  return WayToSeat(*Pin(), *PlateWithHole(depth_mm), geometry::Translation({0, 0, height}),
                   -Vector3::UnitZ(), 2e-3);
}

TEST(WayToSeat, EndsAtTheFloorOfAHole) {
  EXPECT_NEAR(WayFrom(8.35e-3, 12).value(), 0.35e-3, 2e-6);
  EXPECT_NEAR(WayFrom(8e-3, 12).value(), 0, 2e-6);
}

// A pin that is 0.05 mm in the floor goes back. One that is 5 mm in it stays.
TEST(WayToSeat, GoesBackOutOfTheFloor) {
  EXPECT_NEAR(WayFrom(7.95e-3, 12).value(), -0.05e-3, 3e-6);
  EXPECT_LT(WayFrom(7.95e-3, 12).value(), -0.05e-3 + 1e-6);
  EXPECT_EQ(WayFrom(3e-3, 12).value(), 0);
}

// The table is where the lower side of the plate is.
TEST(WayToSeat, EndsAtTheTableUnderAThroughHole) {
  EXPECT_NEAR(WayFrom(0.2e-3, 20).value(), 0.2e-3, 1e-12);
  EXPECT_NEAR(WayFrom(-0.2e-3, 20).value(), -0.2e-3, 1e-12);
}

TEST(WayToSeat, IsNoneIfNothingIsNear) {
  EXPECT_EQ(WayFrom(10.5e-3, 12), std::nullopt);
  EXPECT_EQ(WayFrom(2.5e-3, 20), std::nullopt);
  EXPECT_EQ(WayFrom(-2.5e-3, 20), std::nullopt);
}

}  // namespace
}  // namespace assay::domain::seat_test
