#pragma once

#include <span>
#include <vector>

#include "planner/geometry/polygon.h"
#include "planner/geometry/ring.h"

namespace assay::geometry {

// Splits a simple polygon with holes exactly into convex polygons that do not overlap. The holes
// must be simple, inside the polygon, and apart from each other. Triangles of ears (Meisters 1975)
// are merged while their union is convex.
std::vector<Polygon> ConvexPieces(const Ring& outline, std::span<const Ring> holes);

}  // namespace assay::geometry
