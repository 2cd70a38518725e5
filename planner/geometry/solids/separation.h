#pragma once

#include <span>

#include "planner/geometry/hull.h"

namespace assay::geometry {

// Returns the greatest gap between the projections of two convex solids onto any axis that can
// separate them, in metres: normals of facets, and common normals of two edges. Between solids that
// are apart, it is at most their distance. Between solids that overlap it is negative: the least
// motion that would part them. (Gottschalk, Lin and Manocha 1996.)
double Separation(const ConvexHull& a, const ConvexHull& b);

// Returns the deepest overlap of any solid of `a` with any solid of `b`, in metres; 0 if none
// overlap.
double OverlapDepth(std::span<const ConvexHull> a, std::span<const ConvexHull> b);

}  // namespace assay::geometry
