#pragma once

#include <array>
#include <vector>

#include "planner/geometry/hull.h"

namespace assay::kinematics {

inline constexpr double kSamePoint = 1e-6;      // metres; nearer corners count as one
inline constexpr double kThinnestSolid = 1e-5;  // metres

// The corners of a triangle of a surface.
using SurfaceTriangle = std::array<geometry::Vector3, 3>;

// Returns convex pieces that together contain a solid, given its surface. There is one piece, the
// hull of the surface, if the solid has no deep dents. Else planes across the axes of the frame cut
// the solid, as long as a cut makes the volume of all pieces smaller by a twentieth of that of the
// hull, and up to eight pieces. The surface need not be closed: the pieces contain all triangles.
//
// The surface must span space by kThinnestSolid (checked).
std::vector<geometry::ConvexHull> ConvexPiecesOf(const std::vector<SurfaceTriangle>& surface);

}  // namespace assay::kinematics
