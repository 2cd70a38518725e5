#pragma once

#include <span>

#include "planner/geometry/hull.h"

namespace assay::geometry {

// Returns the index of the first solid that is not connected with the first solid of all, directly
// or by way of others; -1 if there is none. Two solids are connected if they share a volume, or an
// area of their surfaces at least, since edges and corners hold nothing. Facets that are less than
// a micrometre apart count as touching. There must be a solid, and none may be thinner than 10
// micrometres.
int FirstApart(std::span<const ConvexHull> solids);

}  // namespace assay::geometry
