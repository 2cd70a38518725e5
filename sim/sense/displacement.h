#pragma once

#include <Eigen/Core>
#include <cmath>

#include "planner/geometry/pose.h"

namespace assay::sense {

// The difference between two poses of a part that rests in the same stable pose (Spar, equation 2).
// The elements are x, y, z of the part's origin along the world's axes, metres, and the yaw about
// the world's z axis through the part's origin, radians.
using Displacement = Eigen::Vector4d;

// Returns the pose after the displacement `by`.
inline geometry::Pose Displaced(const geometry::Pose& X_WorldPart, const Displacement& by) {
  geometry::Pose moved = geometry::RotationZ(by[3]) * X_WorldPart;
  moved.translation() = X_WorldPart.translation() + by.head<3>();
  return moved;
}

// Returns the displacement that leads from one pose to the other. Both must have the same roll and
// pitch.
inline Displacement Between(const geometry::Pose& from, const geometry::Pose& to) {
  const geometry::Matrix3 turn = to.linear() * from.linear().transpose();
  Displacement by;
  by << to.translation() - from.translation(),
      std::atan2(turn(1, 0) - turn(0, 1), turn(0, 0) + turn(1, 1));
  return by;
}

}  // namespace assay::sense
