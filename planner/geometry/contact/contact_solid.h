#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/geometry/coordinates.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/outline.h"

namespace assay::geometry {

// A convex solid, prepared for contact with other solids.
struct ContactSolid {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3>;  // a vector in each row

  explicit ContactSolid(ConvexHull solid);

  // An edge between two facets. The loop of the left facet goes from `start` to `end`.
  struct Edge {
    int start = 0;  // indices of vertices
    int end = 0;
    int left = 0;  // indices of facets
    int right = 0;
  };

  // Returns the facet's plane, with its normal outward.
  Plane PlaneOf(int facet) const { return {hull.facets[facet].normal, hull.facets[facet].offset}; }

  ConvexHull hull;
  std::vector<Edge> edges;
  Rows vertices;    // those of the hull
  Rows normals;     // of the facets
  Rows directions;  // of the edges, unit, from start to end
  // For each facet, the planes through its sides that are perpendicular to it. Their normals point
  // away from the facet.
  std::vector<std::vector<Plane>> borders;
  struct Disc {
    Vector3 middle;
    double radius = 0;  // metres
  };
  std::vector<Disc> discs;           // for each facet, a disc that lies on it
  Vector3 middle = Vector3::Zero();  // a point inside
};

}  // namespace assay::geometry
