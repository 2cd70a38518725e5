#include "planner/domain/workcell/arm_site.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "planner/base/random.h"
#include "planner/domain/workcell/floor.h"
#include "planner/geometry/pose.h"

namespace assay::domain::arm_site_test {
namespace {

using geometry::Pose;
using geometry::Vector3;
using kinematics::Arm;
using kinematics::Gripper;

Gripper Jaw() {
  return Gripper::FromUrdf(ASSAY_SOURCE_DIR "/models/grippers/parallel-jaw/gripper.urdf");
}

Arm Named(const std::string& name) {
  return Arm::FromUrdf(fmt::format("{0}/models/robots/{1}/{1}.urdf", ASSAY_SOURCE_DIR, name));
}

class Arms : public testing::TestWithParam<const char*> {};

// The tool points straight down at home, and reaches all of the square at the table and at the safe
// height. The arm does not stand on air.
TEST_P(Arms, ReachTheirSquares) {
  const Arm arm = Named(GetParam());
  const Gripper gripper = Jaw();
  const auto site = FindArmSite(arm, gripper);
  ASSERT_TRUE(site);
  EXPECT_GE(site->half_side, 0.10);
  EXPECT_LE(UndersideOf(arm.model().links.front(), site->X_WorldBase).value(), 1e-12);
  const auto tool_at = [&](const kinematics::JointVector& q) -> Pose {
    return site->X_WorldBase * arm.Forward(q) * gripper.X_FlangeTool();
  };
  const Pose home = tool_at(site->home);
  EXPECT_TRUE(arm.InRange(site->home));
  EXPECT_LT((home.linear().col(2) + Vector3::UnitZ()).norm(), 1e-9);
  EXPECT_LT(
      (home.translation() - Vector3(site->middle.x(), site->middle.y(), site->safe_height)).norm(),
      1e-9);
  RandomStream random(5, "square");
  for (int i = 0; i < 200; ++i) {
    const double x = site->middle.x() + random.Uniform(-1, 1) * site->half_side;
    const double y = site->middle.y() + random.Uniform(-1, 1) * site->half_side;
    const double z = random.Uniform(0.01, site->safe_height);
    const Pose X_WorldTool =
        geometry::Translation(x, y, z) * geometry::RotationX(M_PI) * Pose::Identity();
    const Pose X_BaseFlange =
        site->X_WorldBase.inverse() * X_WorldTool * gripper.X_FlangeTool().inverse();
    bool is_reached = false;
    for (const auto& solution : arm.Inverse(X_BaseFlange)) {
      is_reached |= arm.NearestInRange(solution.q, site->home).has_value();
    }
    EXPECT_TRUE(is_reached) << x << " " << y << " " << z << ", seed 5";
  }
}

INSTANTIATE_TEST_SUITE_P(Shipped, Arms,
                         testing::Values("puma762", "ur5e", "irb120", "kr6-r900", "puma560"));

}  // namespace
}  // namespace assay::domain::arm_site_test
