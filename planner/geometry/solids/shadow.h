#pragma once

#include "planner/geometry/hull.h"
#include "planner/geometry/polygon.h"

namespace assay::geometry {

// Returns the exact shadow along z of the part of a solid that lies between the planes z = low and
// z = high (low <= high). The shadow is in the x and y of the solid's frame. Equal planes give the
// cross-section. If the result has fewer than three corners, the solid is not between the planes,
// or only touches them.
Polygon ShadowBetween(const ConvexHull& solid, double low, double high);

}  // namespace assay::geometry
