#pragma once

#include <vector>

#include "planner/geometry/coordinates.h"


namespace assay::geometry {

// The corners of a convex polygon in space, in order: counter-clockwise as seen from where the
// plane's normal points.
using Outline = std::vector<Vector3>;

struct Plane {
  Vector3 normal;
  double height = 0;  // normal . p for each point p of the plane, metres

  double Above(const Vector3& p) const { return normal.dot(p) - height; }
};

struct Segment {
  Vector3 start;
  Vector3 end;

  Vector3 Middle() const { return (start + end) / 2; }
  double Length() const { return (end - start).norm(); }
};

// In the functions below, lengths of at most `tolerance` metres count as 0.

// Returns whether the polygon is wider than `tolerance` in every direction of its plane.
bool IsBroad(const Outline& outline, double tolerance);

struct Halves {
  Outline above;
  Outline below;
};
// Splits a polygon by a plane. Corners within `tolerance` of the plane count as on it and belong to
// both halves. A polygon that lies in the plane is below.
Halves Split(const Outline& outline, const Plane& plane, double tolerance);

// Merges non-overlapping polygons of one plane: two polygons whose union is convex become one,
// until there is no such pair.
std::vector<Outline> Merged(std::vector<Outline> region, const Vector3& normal, double tolerance);

// Groups the polygons of a region. Polygons in one group are connected by more than corners.
std::vector<std::vector<Outline>> ConnectedParts(const std::vector<Outline>& region,
                                                 double tolerance);

// Returns how far a point of the polygon's plane is outside the polygon. It is negative inside.
double DistanceOutside(const Outline& outline, const Vector3& normal, const Vector3& p);

}  // namespace assay::geometry
