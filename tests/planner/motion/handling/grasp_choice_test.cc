#include "planner/motion/handling/grasp_choice.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/geometry/pose.h"
#include "tests/planner/motion/handling/cans.h"

namespace assay::motion::grasp_choice_test {
namespace {

double Lean(const Pose& X_WorldPart, const Pose& X_PartTool) {
  return (X_WorldPart * X_PartTool).linear()(2, 2);
}

// Enumerates all grasps that are reachable and free.
TEST(MostUprightHold, ComesMostFromAboveOfAllThatArePossible) {
  const Pose X_WorldPart = Cans().part(kCan).X_WorldPart;
  const std::vector<domain::PlacedPart> others = CanInTheHand().parts;
  const auto hold = MostUprightHold(Cans(), kCan, X_WorldPart, others);
  ASSERT_TRUE(hold);
  const double open = Cans().workcell->gripper().max_opening();
  bool is_listed = false;
  for (std::size_t i = 0; i < Cans().part(kCan).grasps->size(); ++i) {
    const domain::Grasp& grasp = (*Cans().part(kCan).grasps)[i];
    if (!IsReachableAt(Cans(), kCan, domain::GraspId(i), X_WorldPart)) continue;
    if (!Obstacle(Cans(), X_WorldPart * grasp.X_PartTool, open, others).IsNone()) continue;
    EXPECT_LE(Lean(X_WorldPart, hold->X_PartTool), Lean(X_WorldPart, grasp.X_PartTool) + 1e-6);
    is_listed |= grasp.label == hold->grasp && grasp.width == hold->width;
  }
  EXPECT_TRUE(is_listed);
}

TEST(MostUprightHold, IsNoneWhereTheArmDoesNotReach) {
  EXPECT_FALSE(MostUprightHold(Cans(), kCan, geometry::Translation(3, 0, 0), {}));
}

TEST(MostUprightHold, IsNoneWhereOthersStandAllAround) {
  const Pose X_WorldPart = Cans().part(kCan).X_WorldPart;
  std::vector<domain::PlacedPart> others;
  for (int i = 0; i < 8; ++i) {
    const double angle = i * M_PI / 4;
    others.push_back(
        {kOtherCan, geometry::Translation(0.062 * std::cos(angle), 0.062 * std::sin(angle), 0.05) *
                        X_WorldPart});
  }
  EXPECT_FALSE(MostUprightHold(Cans(), kCan, X_WorldPart, others));
}

}  // namespace
}  // namespace assay::motion::grasp_choice_test
