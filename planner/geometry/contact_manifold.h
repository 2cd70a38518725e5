#pragma once

#include <optional>
#include <vector>

#include "planner/geometry/hull.h"
#include "planner/geometry/pose.h"

namespace assay::geometry {

// A convex solid, prepared for contact with other solids: its facets and the directions of its
// edges, without repetitions of parallel ones.
struct ContactSolid {
  explicit ContactSolid(ConvexHull solid);

  struct Edge {
    int start = 0;  // indices of vertices
    int end = 0;
  };
  ConvexHull hull;
  std::vector<Edge> edges;
  std::vector<Vector3> directions;  // unit; each edge is parallel to one of them
};

// The contact of two convex solids: points with one common normal.
struct ContactManifold {
  struct Point {
    Vector3 at;             // midway between the two surfaces
    double separation = 0;  // metres; negative if they overlap
  };
  Vector3 normal = Vector3::UnitZ();  // unit, from the first solid to the second
  std::vector<Point> points;
};

// Returns the contact of two solids that are at most `margin` apart, or none. The normal is that of
// the axis of least overlap among the normals of facets and the common normals of edges
// (Gottschalk, Lin and Manocha 1996). Where facets meet, the points are the corners of their common
// area, and where edges cross, there is one point. A facet is preferred to a pair of edges that is
// hardly better, since an area of contact holds still where a single point does not.
std::optional<ContactManifold> ContactBetween(const ContactSolid& a, const Pose& X_WorldA,
                                              const ContactSolid& b, const Pose& X_WorldB,
                                              double margin);

}  // namespace assay::geometry
