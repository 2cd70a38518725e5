#pragma once

#include <limits>
#include <span>
#include <vector>

#include "planner/geometry/coordinates.h"

namespace assay::geometry {

// Returns the convex hull of the points, by Andrew's monotone chain (1979). No three corners are on
// a line. The first corner is least in x, then in y. There are one or two corners if the points
// span no area.
Polygon Hull2(std::span<const Vector2> points);
double Area(const Polygon& polygon);       // 0 for fewer than three corners
Vector2 Centroid(const Polygon& polygon);  // of the area; without an area the mean of the corners
// Returns the root of the mean square of the distance between the points of disjoint polygons and
// their common centroid; 0 without an area.
double RadiusOfGyration(std::span<const Polygon> polygons);
// Returns the intersection of two polygons (Sutherland and Hodgman 1974). It is empty if they share
// no area.
Polygon Intersection(const Polygon& a, const Polygon& b);
// Returns how far p is inside the polygon: the least distance to an edge's line, negative outside.
// For a point or a segment it is minus the distance, and for an empty polygon minus infinity.
double Depth(const Polygon& polygon, const Vector2& p);
// Returns the points that are at least `depth` >= 0 inside the polygon (Depth). It is empty if they
// cover no area.
Polygon Inset(const Polygon& polygon, double depth);
// Returns the separation of two convex polygons along the best separating axis. A negative value is
// the depth of their overlap. If the separation is at least `enough`, the result is any number from
// `enough` to it, which is found sooner.
double Gap(const Polygon& a, const Polygon& b,
           double enough = std::numeric_limits<double>::infinity());

}  // namespace assay::geometry
