#pragma once

#include <span>
#include <vector>

#include "planner/geometry/coordinates.h"

namespace assay::geometry {

// A polygon that need not be convex: corners in either direction of turn.
using Ring = std::vector<Vector2>;

// Returns the area that a polygon encloses, negative if it runs clockwise.
double SignedArea(std::span<const Vector2> ring);
// Returns whether no two sides of the polygon meet except neighbours in their common corner.
bool IsSimple(const Ring& ring);
// Returns whether sides of the two polygons cross or touch.
bool SidesMeet(const Ring& a, const Ring& b);
// Returns whether p is inside the polygon, by the parity of the sides to its right.
bool IsInside(std::span<const Vector2> ring, const Vector2& p);

}  // namespace assay::geometry
