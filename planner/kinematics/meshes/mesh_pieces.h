#pragma once

#include <array>
#include <vector>

#include "planner/geometry/hull.h"

namespace assay::kinematics {

inline constexpr double kSamePoint = 1e-6;      // metres; nearer corners count as one
inline constexpr double kThinnestSolid = 1e-5;  // metres
// The least share of the volume of the whole hull by which a cut makes the volume smaller.
inline constexpr double kLeastCutGain = 0.05;

// The corners of a triangle of a surface.
using SurfaceTriangle = std::array<geometry::Vector3, 3>;

// Returns convex pieces that together contain a solid, given its closed surface. There is one
// piece, the hull of the surface, if the solid has no deep dents. Else planes across one or two
// axes of the frame cut the solid, as long as a cut gains enough (kLeastCutGain), and up to eight
// pieces. If the surface is not closed, the pieces contain all triangles.
//
// The surface must span space by kThinnestSolid (checked).
std::vector<geometry::ConvexHull> ConvexPiecesOf(const std::vector<SurfaceTriangle>& surface);

}  // namespace assay::kinematics
