#pragma once

#include <optional>
#include <span>

#include "planner/domain/workcell/workcell.h"

namespace assay::domain {

// Returns whether the arm reaches the pose of the tool within its joint limits, in any
// configuration.
bool IsReached(const Workcell& workcell, const geometry::Pose& X_WorldTool);

// Returns whether the arm can move the tool along the straight lines from corner to corner. The
// tool keeps its orientation. The arm stays within its joint limits, keeps its configuration, and
// makes no sudden turns of a joint. If the workcell's rules let the arm change its configuration
// (WorkcellRules), the arm only needs to reach each tested pose. The corners are origins of the
// tool in the world frame; there must be at least one. The lines are tested in steps of a few
// centimetres.
bool CanFollow(const Workcell& workcell, const geometry::Matrix3& R_WorldTool,
               std::span<const geometry::Vector3> corners);

// The distance that the arm gets along a path of the tool through a list of poses. Between two
// poses, the tool's origin moves on a straight line, and the tool turns about one axis.
struct PathReach {
  // Number of poses, from the first on, that the best single configuration reaches.
  std::size_t reached = 0;
  // The joint values at the first pose, in a configuration in which the arm reaches the last pose.
  // If there are several, the joint values nearest to the workcell's home are taken. None if there
  // is no such configuration.
  std::optional<kinematics::JointVector> start = {};
};
PathReach ReachAlong(const Workcell& workcell, std::span<const geometry::Pose> X_WorldTools);

}  // namespace assay::domain
