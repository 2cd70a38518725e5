#pragma once

#include "planner/geometry/box.h"
#include "planner/geometry/polygon.h"

namespace assay::geometry {

// Returns the exact shadow along z of the part of a box that lies between the planes z = low and z
// = high (low <= high) of a frame. The shadow is in the frame's x and y. Equal planes give the
// cross-section. If the result has fewer than three corners, the box is not between the planes, or
// only touches them.
Polygon ShadowBetween(const Box& box, double low, double high);

}  // namespace assay::geometry
