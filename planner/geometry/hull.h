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
  std::vector<int> loop;  // vertex indices, counter-clockwise seen from outside
};

struct ConvexHull {
  std::vector<Vector3> vertices;
  std::vector<Facet> facets;  // coplanar triangles are merged into one facet
};

// Returns the convex hull of points that span three dimensions (checked). The order of vertices and
// facets depends only on the points. (Qhull: Barber, Dobkin and Huhdanpaa 1996.)
ConvexHull HullOf(std::span<const Vector3> points);

// Returns a hull whose facets are known, without the use of Qhull. Each loop lists the vertices of
// a facet counter-clockwise, seen from outside.
ConvexHull HullWith(std::vector<Vector3> vertices, std::vector<std::vector<int>> loops);
ConvexHull HullOf(const Box& box);

}  // namespace assay::geometry
