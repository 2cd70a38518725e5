#pragma once

#include <vector>

#include "planner/geometry/polygon.h"

namespace assay::domain {

// A region of the plane, with holes and in several pieces if need be, as convex polygons that do
// not overlap. Areas below kSliver count as rounding.
using Patches = std::vector<geometry::Polygon>;
constexpr double kSliver = 1e-12;  // square metres

// The region without a convex cut. At most one new patch for each edge of the cut.
Patches Without(const Patches& region, const geometry::Polygon& cut);
// What two regions have in common.
Patches Common(const Patches& a, const Patches& b);

double Area(const Patches& region);
geometry::Vector2 Centroid(const Patches& region);  // of the area, which must not be 0 (checked)
geometry::Polygon Hull(const Patches& region);

// Whether the region has area under the polygon; whether it fills the polygon.
bool Meets(const Patches& region, const geometry::Polygon& polygon);
bool Fills(const Patches& region, const geometry::Polygon& polygon);

}  // namespace assay::domain
