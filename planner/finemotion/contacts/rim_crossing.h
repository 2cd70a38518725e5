#pragma once

#include <optional>

#include "planner/geometry/coordinates.h"

namespace assay::finemotion {

// A circle, the edge of a cylinder's end.
struct Rim {
  geometry::Vector3 center;
  geometry::Vector3 axis;  // unit vector
  double radius = 0;       // metres
};

// A place where two rims cross as seen along a common normal: the line between the two points is
// perpendicular to both rims there.
struct RimCrossing {
  geometry::Vector3 on_first;
  geometry::Vector3 on_second;
  geometry::Vector3 normal;  // unit vector, toward the side to which the second rim's axis points
  double sine = 0;           // sine of the angle between the rims there
};

// Returns the crossing of two rims whose axes are roughly opposite. A walk around the first rim,
// about its axis, passes two crossings with the second rim. At one of them the walk leaves the
// inside of the second rim, as seen along the second axis (`sense` 1). At the other it enters this
// inside (`sense` -1). Returns none if the rims do not cross. If there are more crossings in this
// sense, returns the one with the nearest points.
std::optional<RimCrossing> CrossingOf(const Rim& first, const Rim& second, int sense);

}  // namespace assay::finemotion
