#pragma once

#include <span>
#include <vector>

#include "planner/geometry/box.h"
#include "planner/geometry/pose.h"

namespace assay::geometry {

// A planar facet of a convex hull.
struct Facet {
  Vector3 normal;         // unit, outward
  double offset = 0;      // normal . p == offset on the facet
  std::vector<int> loop;  // indices of vertices, counter-clockwise seen from outside
};

struct ConvexHull {
  std::vector<Vector3> vertices;
  std::vector<Facet> facets;  // coplanar triangles merged into one facet
};

// The hull of points that span three dimensions (checked). Vertices and facets come in an order
// that depends on the points alone. (Qhull: Barber, Dobkin and Huhdanpaa 1996.)
ConvexHull HullOf(std::span<const Vector3> points);

// The same where it is known which points make the facets, each counter-clockwise seen from
// outside: without Qhull.
ConvexHull HullWith(std::vector<Vector3> vertices, std::vector<std::vector<int>> loops);
ConvexHull HullOf(const Box& box);

}  // namespace assay::geometry
