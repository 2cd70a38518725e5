#include "planner/domain/grasps/round_side.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "planner/domain/parts/part_model.h"
#include "planner/geometry/pose.h"
#include "tests/planner/domain/parts.h"

namespace assay::domain::round_side_test {
namespace {

// Returns a cylinder along z, of 20 mm diameter and 50 mm length, and what is added to its file.
std::shared_ptr<const PartModel> Cylinder(int sides, const std::string& more = "") {
  return ParsePart(fmt::format(R"(
format: assay-part/1
name: cylinder
initial: C
units: {{length: mm, angle: degree}}
density: 1000
friction: 0.25
solids:
  body: {{cylinder: {{from: [0, 0, 0], to: [0, 0, 50], radius: 10, sides: {}}}}}
{})",
                               sides, more));
}

std::optional<RoundSide> SideOf(const PartModel& part, double radius = 0.01) {
  return RoundSideAbout(part, Pose::Identity(), radius);
}

TEST(RoundSide, HasAllFacesAroundTheAxis) {
  for (const int sides : {12, 32, 64}) {
    const auto part = Cylinder(sides);
    const auto side = SideOf(*part);
    ASSERT_TRUE(side) << sides;
    EXPECT_EQ(side->faces.size(), static_cast<std::size_t>(sides));
    EXPECT_NEAR(side->half_step, M_PI / sides, 1e-9);
    EXPECT_NEAR(side->OuterRadius(), part->corners().front().head<2>().norm(), 1e-9);
    EXPECT_TRUE(IsRoundBetween(*part, *side, {0, 0.05}));
    EXPECT_FALSE(IsRoundBetween(*part, *side, {0, 0.051}));
  }
}

TEST(RoundSide, IsNoneOfAPolygonWithFewSides) { EXPECT_FALSE(SideOf(*Cylinder(8))); }

TEST(RoundSide, IsNoneAboutAnotherAxisOrAtAnotherRadius) {
  const auto part = Cylinder(64);
  EXPECT_FALSE(SideOf(*part, 0.0101));
  EXPECT_FALSE(RoundSideAbout(*part, geometry::Translation(1e-4, 0, 0), 0.01));
  EXPECT_FALSE(RoundSideAbout(*part, geometry::RotationX(0.01), 0.01));
}

TEST(RoundSide, IsNotRoundWhereASlotIsCut) {
  const auto part =
      Cylinder(64, "pockets:\n  slot: {cut_from: body, box: [[8, -2, 30], [11, 2, 40]]}\n");
  const auto side = SideOf(*part);
  ASSERT_TRUE(side);
  EXPECT_TRUE(IsRoundBetween(*part, *side, {0, 0.0299}));
  EXPECT_FALSE(IsRoundBetween(*part, *side, {0.02, 0.035}));
  EXPECT_TRUE(IsRoundBetween(*part, *side, {0.0401, 0.05}));
}

TEST(RoundSide, AFlangeIsOutsideOfTheCircle) {
  const auto part = Cylinder(64, "  flange: {box: [[-9, -9, -5], [9, 9, 0]]}\n");
  const auto side = SideOf(*part);
  ASSERT_TRUE(side);
  EXPECT_TRUE(IsInsideCircle(*part, *side, {0.001, 0.06}));
  EXPECT_FALSE(IsInsideCircle(*part, *side, {-0.004, 0.05}));  // its corners are 12.7 mm away
}

}  // namespace
}  // namespace assay::domain::round_side_test
