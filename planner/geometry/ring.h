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
// Returns a convex polygon that runs counter-clockwise with each side moved outward by `by` metres,
// or inward if `by` is negative. Sides that have moved inward too far run backwards.
Ring MovedOutward(const Ring& convex, double by);

}  // namespace assay::geometry
