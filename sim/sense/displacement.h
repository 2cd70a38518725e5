#pragma once

#include <Eigen/Core>

#include "planner/geometry/coordinates.h"

namespace assay::sense {

// The difference between two poses of a part that rests in the same stable pose (Spar, equation 2).
// The elements are x, y, z of the part's origin along the world's axes, metres, and the yaw about
// the world's z axis through the part's origin, radians.
using Displacement = Eigen::Vector4d;

// Returns the pose after the displacement `by`.
geometry::Pose Displaced(const geometry::Pose& X_WorldPart, const Displacement& by);

// Returns the displacement that leads from one pose to the other. Both must have the same roll and
// pitch.
Displacement Between(const geometry::Pose& from, const geometry::Pose& to);

}  // namespace assay::sense
