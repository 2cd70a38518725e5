#include "planner/domain/resting/resting.h"

#include <gtest/gtest.h>

#include <numbers>

#include "planner/geometry/polygon.h"
#include "planner/geometry/pose.h"
#include "tests/planner/domain/scenario.h"

namespace assay::domain::resting_test {
namespace {

constexpr double kInch = 0.0254;
constexpr double kDegree = std::numbers::pi / 180;

class Resting : public testing::Test {
 protected:
  const Problem problem_ = LoadScenario("clutter");
  const PartId block_ = PartNamed(problem_, "block");
  const PartId brick_ = PartNamed(problem_, "brick");

  Pose InPose(PartId part, const char* name, const Placement& placement) const {
    const Part& p = problem_.part(part);
    return PoseAt(p, p.model->FindStablePose(name), placement);
  }
};

TEST_F(Resting, FootprintTurnsWithThePart) {
  const Part& block = problem_.part(block_);
  for (const double yaw : {0.0, 90.0, 37.0, 200.0}) {
    const geometry::Polygon footprint =
        Footprint(block, InPose(block_, "on-back", {.x = 0.5, .y = 0.1, .yaw = yaw * kDegree}));
    EXPECT_EQ(footprint.size(), 4u);
    EXPECT_NEAR(geometry::Area(footprint), 3 * 6.5 * kInch * kInch, 1e-9) << yaw;
  }
}

// The narrow table ends at x = 0.73 m, and an upright brick is 2 inches wide.
TEST_F(Resting, OnTableUpToTheEdge) {
  EXPECT_TRUE(OnTable(problem_, brick_, InPose(brick_, "upright", {.x = 0.73 - kInch})));
  EXPECT_FALSE(OnTable(problem_, brick_, InPose(brick_, "upright", {.x = 0.7301 - kInch})));
  EXPECT_FALSE(OnTable(problem_, brick_,
                       InPose(brick_, "upright", {.x = 0.73 - kInch, .yaw = 45 * kDegree})));
}

TEST_F(Resting, CrowdingWithinThePartGap) {
  const double gap = problem_.workcell->rules().part_gap;
  const Pose X_WorldBrick = InPose(brick_, "upright", {.x = 0.5});
  const auto crowded_by = [&](double distance) {
    const std::vector<PlacedPart> others = {
        {brick_, X_WorldBrick},  // the part itself, which does not count
        {block_, InPose(block_, "on-end", {.x = 0.5 + kInch + distance})}};
    return Crowding(problem_, brick_, X_WorldBrick, others);
  };
  EXPECT_EQ(crowded_by(gap - 1e-4), block_);
  EXPECT_EQ(crowded_by(-0.01), block_);
  EXPECT_EQ(crowded_by(gap + 1e-4), PartId::None());
}

TEST_F(Resting, FindsEveryStablePoseAtEveryYaw) {
  for (const Part& part : problem_.parts) {
    for (std::size_t i = 0; i < part.model->stable_poses().size(); ++i) {
      for (int yaw = -180; yaw < 180; yaw += 25) {
        const Placement placement = {.x = 0.5, .y = -0.2, .yaw = yaw * kDegree};
        EXPECT_EQ(StablePoseAt(part, PoseAt(part, StablePoseId(i), placement)), StablePoseId(i))
            << part.name << " " << part.model->stable_poses()[i].label << " yaw " << yaw;
      }
    }
  }
}

TEST_F(Resting, APartThatLeansOrFloatsRestsInNone) {
  const Part& brick = problem_.part(brick_);
  const Pose X_WorldPart = InPose(brick_, "upright", {.x = 0.5});
  const StablePoseId upright = brick.model->FindStablePose("upright");
  EXPECT_EQ(StablePoseAt(brick, X_WorldPart * geometry::RotationX(0.5 * kDegree)), upright);
  EXPECT_EQ(StablePoseAt(brick, X_WorldPart * geometry::RotationX(1.5 * kDegree)),
            StablePoseId::None());
  EXPECT_EQ(StablePoseAt(brick, geometry::Translation(0, 0, 0.0005) * X_WorldPart), upright);
  EXPECT_EQ(StablePoseAt(brick, geometry::Translation(0, 0, 0.002) * X_WorldPart),
            StablePoseId::None());
}

// The property that the scenario needs: the block can lie on its back at only one placement, where
// the brick is in its way. At another place the brick can stand and the block cannot lie.
TEST_F(Resting, TheBrickStandsWhereTheBlockMustLie) {
  const std::vector<PlacedPart> start = {{brick_, problem_.part(brick_).X_WorldPart}};
  std::vector<Placement> for_block;
  bool brick_can_go_elsewhere = false;
  for (const Placement& placement : problem_.workcell->placements()) {
    const Pose X_WorldBlock = InPose(block_, "on-back", placement);
    if (OnTable(problem_, block_, X_WorldBlock)) {
      for_block.push_back(placement);
      EXPECT_EQ(Crowding(problem_, block_, X_WorldBlock, start), brick_);
    }
    const Pose X_WorldBrick = InPose(brick_, "upright", placement);
    brick_can_go_elsewhere |= placement.y > 0.3 && OnTable(problem_, brick_, X_WorldBrick);
  }
  EXPECT_EQ(for_block.size(), 1u);
  EXPECT_TRUE(brick_can_go_elsewhere);
}

}  // namespace
}  // namespace assay::domain::resting_test
