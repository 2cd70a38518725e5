#pragma once

#include <span>
#include <vector>

#include "planner/geometry/box.h"
#include "planner/geometry/rounded_hull.h"
#include "planner/kinematics/urdf_model.h"

namespace assay::motion {

// A polyhedron that holds a shape of a URDF file, in the frame of its link. A box is itself; a
// cylinder becomes a prism of 16 sides around it (2 % wider at its edges), a sphere an icosahedron
// around it.
geometry::RoundedHull HullAround(const kinematics::Shape& shape, const geometry::Pose& X_LinkShape);

std::vector<geometry::RoundedHull> HullsOf(std::span<const geometry::Box> boxes,
                                           const geometry::Pose& X_LinkBoxes);

}  // namespace assay::motion
