#include "sim/execution/world_model/world_model.h"

#include <gtest/gtest.h>

#include "planner/geometry/pose.h"
#include "tests/sim/execution/figure15.h"

namespace assay::execution::world_model_test {
namespace {

TEST(WorldModelTest, FollowsTheCommands) {
  const domain::Problem problem = Figure15();
  const PartId peg = PartNamed(problem, "peg");
  WorldModel world(problem);
  const Pose tool = geometry::Translation(0.6, 0, 0.4) * geometry::RotationX(3);
  EXPECT_TRUE(world.PartPose(peg, tool).isApprox(problem.part(peg).X_WorldPart));
  const plan::Hold hold{"grasp", geometry::Translation(0.01, 0.02, 0.03), 0.05};
  world.Take(peg, hold);
  EXPECT_EQ(world.held(), peg);
  EXPECT_TRUE((world.PartPose(peg, tool) * hold.X_PartTool).isApprox(tool, 1e-12));
  const Pose placed = geometry::Translation(0.7, 0.1, 0.0);
  world.LetGo(peg, placed);
  EXPECT_TRUE(world.held().IsNone());
  EXPECT_TRUE(world.PartPose(peg, tool).isApprox(placed));
}

}  // namespace
}  // namespace assay::execution::world_model_test
