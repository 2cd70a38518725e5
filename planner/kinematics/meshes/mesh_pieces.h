#pragma once

#include <array>
#include <vector>

#include "planner/geometry/hull.h"

namespace assay::kinematics {

// The corners of a triangle of a surface.
using SurfaceTriangle = std::array<geometry::Vector3, 3>;

// Returns convex pieces that together contain a solid, given its surface. There is one piece, the
// hull of the surface, if the solid has no deep dents. Else planes across the axes of the frame cut
// the solid, as long as a cut makes the volume of all pieces smaller by a twentieth of that of the
// hull, and up to eight pieces. The surface need not be closed: the pieces contain all triangles.
//
// Points closer than a micrometre count as one. The surface must span space (checked).
std::vector<geometry::ConvexHull> ConvexPiecesOf(const std::vector<SurfaceTriangle>& surface);

}  // namespace assay::kinematics
