#pragma once

#include <vector>

#include "planner/geometry/polygon.h"

namespace assay::domain {

// A region of the plane, as convex polygons that do not overlap. It may have holes and several
// pieces. Areas below kSliver count as rounding.
using Patches = std::vector<geometry::Polygon>;
constexpr double kSliver = 1e-12;  // square metres

// Returns the region without a convex cut. The cut adds at most one patch for each of its edges.
Patches Without(const Patches& region, const geometry::Polygon& cut);
// Returns the intersection of two regions.
Patches Common(const Patches& a, const Patches& b);

double Area(const Patches& region);
// Centroid of the area, which must not be 0 (checked).
geometry::Vector2 Centroid(const Patches& region);
geometry::Polygon Hull(const Patches& region);

// Meets returns whether the region covers some area of the polygon; Fills returns whether it covers
// the whole polygon.
bool Meets(const Patches& region, const geometry::Polygon& polygon);
bool Fills(const Patches& region, const geometry::Polygon& polygon);

}  // namespace assay::domain
