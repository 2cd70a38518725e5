#pragma once

#include "planner/geometry/hull.h"

namespace assay::geometry {

// Returns the exact distance of a point from a convex solid, in metres; 0 inside.
double DistanceTo(const ConvexHull& solid, const Vector3& p);

}  // namespace assay::geometry
