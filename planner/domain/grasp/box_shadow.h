#pragma once

#include "planner/geometry/box.h"
#include "planner/geometry/polygon.h"

namespace assay::domain {

// What of a box lies between two planes z = low and z = high (low <= high) of a frame, seen along
// z: the exact shadow of the cut box, in the frame's x and y. Equal planes give the cross-section.
// Fewer than three corners: the box is not between the planes, or only touches them.
geometry::Polygon ShadowBetween(const geometry::Box& box, double low, double high);

}  // namespace assay::domain
