#pragma once

#include <span>
#include <vector>

#include "planner/geometry/rounded_hull.h"
#include "planner/kinematics/urdf_model.h"

namespace assay::motion {

// Returns a polyhedron that contains a shape of a URDF file, in the frame of its link. A box is
// itself. A cylinder becomes a prism of 16 sides around it (2 % wider at its edges), and a sphere
// an icosahedron around it.
geometry::RoundedHull HullAround(const kinematics::Shape& shape, const geometry::Pose& X_LinkShape);

// Returns the solids in the frame of a link.
std::vector<geometry::RoundedHull> HullsOf(std::span<const geometry::ConvexHull> solids,
                                           const geometry::Pose& X_LinkSolids);

}  // namespace assay::motion
