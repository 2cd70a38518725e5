#pragma once

#include <optional>
#include <span>

#include "planner/domain/workcell/workcell.h"

namespace assay::domain {

// Whether the arm can move the tool, its orientation kept, along the straight lines from corner to
// corner (origins of the tool, world frame; at least one) within its joint limits and without
// changing its configuration or turning a joint by leaps on the way. Looked at in steps of a few
// centimetres.
bool CanFollow(const Workcell& workcell, const geometry::Matrix3& R_WorldTool,
               std::span<const geometry::Vector3> corners);

// How far the arm gets along a path of the tool from pose to pose, its origin on straight lines and
// turning about one axis between two poses.
struct PathReach {
  // So many poses from the first on are reached, as far as any one configuration gets.
  std::size_t reached = 0;
  // At the first pose, of the configurations that come to the last one that which is the nearest to
  // the workcell's home; none if none does.
  std::optional<kinematics::JointVector> start = {};
};
PathReach ReachAlong(const Workcell& workcell, std::span<const geometry::Pose> X_WorldTools);

}  // namespace assay::domain
