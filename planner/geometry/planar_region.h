#pragma once

#include <vector>

#include "planner/geometry/polygon.h"

namespace assay::geometry {

// A region of the plane, as convex polygons that do not overlap. It may have holes and several
// pieces. Areas below kSliverArea count as rounding.
using Patches = std::vector<Polygon>;
constexpr double kSliverArea = 1e-12;  // square metres

// Returns the region without a convex cut. The cut adds at most one patch for each of its edges.
Patches Without(const Patches& region, const Polygon& cut);
// Returns the intersection of two regions.
Patches Common(const Patches& a, const Patches& b);

double Area(const Patches& region);
// Centroid of the area, which must not be 0 (checked).
Vector2 Centroid(const Patches& region);
Polygon Hull(const Patches& region);

// Meets returns whether the region covers some area of the polygon; Fills returns whether it covers
// the whole polygon.
bool Meets(const Patches& region, const Polygon& polygon);
bool Fills(const Patches& region, const Polygon& polygon);

}  // namespace assay::geometry
