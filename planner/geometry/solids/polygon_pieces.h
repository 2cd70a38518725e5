#pragma once

#include <span>
#include <vector>

#include "planner/geometry/polygon.h"

namespace assay::geometry {

// A simple polygon: corners in either direction of turn, convex or concave.
using Ring = std::vector<Vector2>;

// Returns whether no two sides of the polygon meet except neighbours in their common corner.
bool IsSimple(const Ring& ring);
// Returns whether sides of the two polygons cross or touch.
bool SidesMeet(const Ring& a, const Ring& b);
// Returns whether p is inside the polygon, by the parity of crossings.
bool IsInside(const Ring& ring, const Vector2& p);

// Splits a simple polygon with holes exactly into convex polygons that do not overlap. The holes
// must be simple, inside the polygon, and apart from each other. Triangles of ears (Meisters 1975)
// are merged while their union is convex.
std::vector<Polygon> ConvexPieces(const Ring& outline, std::span<const Ring> holes);

}  // namespace assay::geometry
