#pragma once

#include <span>
#include <vector>

#include "planner/geometry/pose.h"

namespace assay::geometry {

// A convex polygon in the plane, corners counter-clockwise.
using Polygon = std::vector<Vector2>;

// Andrew's monotone chain (1979): no three corners on a line, the first corner least in x, then y.
// One or two corners if the points span no area.
Polygon Hull2(std::span<const Vector2> points);
double Area(const Polygon& polygon);       // 0 for fewer than three corners
Vector2 Centroid(const Polygon& polygon);  // of the area; without one, the mean corner
// Sutherland and Hodgman 1974. Empty if the polygons share no area.
Polygon Intersection(const Polygon& a, const Polygon& b);
// How far p is inside the polygon: the least distance to an edge's line, negative outside. Of a
// point or a segment: minus the distance; of nothing: minus infinity.
double Depth(const Polygon& polygon, const Vector2& p);
// The separation of two convex polygons along the best separating axis; negative: they overlap by
// that much.
double Gap(const Polygon& a, const Polygon& b);

}  // namespace assay::geometry
