#pragma once

#include <vector>

#include "planner/geometry/coordinates.h"


namespace assay::mesh_import {

// A notch in a straight side of a polygon: a slot or a T-slot, seen along its length.
struct Notch {
  std::vector<geometry::Vector2> outline;  // counter-clockwise, with the mouth as one side
  geometry::Vector2 outward;               // unit normal of the mouth
};

// Fills the notches of a counter-clockwise polygon and returns them. A notch begins and ends on one
// straight line, and the polygon has an edge on this line on each side of the mouth. Notches that
// would add more than half of the area are part of the shape and stay.
std::vector<Notch> FillNotches(std::vector<geometry::Vector2>& polygon, double tolerance);

}  // namespace assay::mesh_import
