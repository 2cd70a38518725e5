#pragma once

#include "planner/base/check.h"
#include "planner/domain/workcell/workcell.h"
#include "planner/geometry/pose.h"

namespace assay::scene {

// Returns a pose of the tool that points straight down and closes along the world's y. The place is
// in metres, in the world frame.
inline geometry::Pose ToolDown(double x, double y, double z) {
  return geometry::PoseFromColumns({-1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {x, y, z});
}

// Returns the joint values nearest to home that bring the tool to this pose.
inline kinematics::JointVector JointsFor(const domain::Workcell& workcell,
                                         const geometry::Pose& X_WorldTool) {
  const auto solutions = workcell.arm().Inverse(workcell.FlangeFor(X_WorldTool));
  std::optional<kinematics::JointVector> best;
  for (const auto& solution : solutions) {
    const auto q = workcell.arm().NearestInRange(solution.q, workcell.home());
    if (!q) continue;
    const auto distance = [&](const auto& joints) { return (joints - workcell.home()).norm(); };
    if (!best || distance(*q) < distance(*best)) best = q;
  }
  ASSAY_CHECK(best.has_value(), "out of reach");
  return *best;
}

}  // namespace assay::scene
