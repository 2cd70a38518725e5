#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "planner/domain/parts/part_model.h"
#include "planner/geometry/box.h"
#include "planner/geometry/hull.h"
#include "tests/oracle/box_pair.h"

// Convex solids, slowly and by definition.
namespace assay::oracle {

using geometry::ConvexHull;
using geometry::Pose;

// A convex solid with the directions that can separate it from another one.
struct ConvexSolid {
  ConvexHull hull;
  // Unit vectors, of two opposite ones only the first.
  std::vector<Vector3> normals;
  std::vector<Vector3> edges;

  ConvexSolid Transformed(const Pose& X_NewFrame) const {
    ConvexSolid moved = {geometry::Transformed(hull, X_NewFrame), normals, edges};
    for (Vector3& normal : moved.normals) normal = X_NewFrame.linear() * normal;
    for (Vector3& edge : moved.edges) edge = X_NewFrame.linear() * edge;
    return moved;
  }
};

inline ConvexSolid SolidOf(ConvexHull hull) {
  ConvexSolid solid;
  const auto add = [](std::vector<Vector3>& directions, const Vector3& direction) {
    const auto is_same = [&](const Vector3& d) { return d.cross(direction).norm() < 1e-9; };
    if (std::ranges::none_of(directions, is_same)) directions.push_back(direction);
  };
  for (const geometry::Facet& facet : hull.facets) {
    add(solid.normals, facet.normal);
    for (std::size_t i = 0; i < facet.loop.size(); ++i) {
      const Vector3& next = hull.vertices[facet.loop[(i + 1) % facet.loop.size()]];
      add(solid.edges, (next - hull.vertices[facet.loop[i]]).normalized());
    }
  }
  solid.hull = std::move(hull);
  return solid;
}

inline std::vector<ConvexSolid> SolidsOf(const domain::PartModel& part) {
  std::vector<ConvexSolid> solids;
  for (const ConvexHull& piece : part.pieces()) solids.push_back(SolidOf(piece));
  return solids;
}
inline std::vector<ConvexSolid> SolidsOf(std::span<const Box> boxes) {
  std::vector<ConvexSolid> solids;
  for (const Box& box : boxes) solids.push_back(SolidOf(geometry::HullOf(box)));
  return solids;
}

// Returns how far two solids are apart along a unit vector, in either order.
inline double GapAlong(const Vector3& axis, const ConvexSolid& a, const ConvexSolid& b) {
  const auto along = [&](const Vector3& p) { return axis.dot(p); };
  const auto [a_low, a_high] = std::ranges::minmax(a.hull.vertices, {}, along);
  const auto [b_low, b_high] = std::ranges::minmax(b.hull.vertices, {}, along);
  return std::max(along(b_low) - along(a_high), along(a_low) - along(b_high));
}

// Returns the greatest separation over the normals of both solids and the cross products of their
// edges. For solids that overlap, it is minus the least overlap. Cross products of nearly parallel
// edges are left out because they add nothing.
inline double Separation(const ConvexSolid& a, const ConvexSolid& b) {
  double best = -std::numeric_limits<double>::infinity();
  for (const Vector3& axis : a.normals) best = std::max(best, GapAlong(axis, a, b));
  for (const Vector3& axis : b.normals) best = std::max(best, GapAlong(axis, a, b));
  for (const Vector3& of_a : a.edges) {
    for (const Vector3& of_b : b.edges) {
      const Vector3 cross = of_a.cross(of_b);
      if (cross.norm() > 1e-6) best = std::max(best, GapAlong(cross.normalized(), a, b));
    }
  }
  return best;
}

// Returns whether p is in the solid, or at most `tolerance` beyond the plane of a facet.
inline bool IsWithin(const ConvexHull& solid, const Vector3& p, double tolerance) {
  return std::ranges::all_of(solid.facets, [&](const geometry::Facet& facet) {
    return facet.normal.dot(p - solid.vertices[facet.loop[0]]) <= tolerance;
  });
}

// Returns whether a ray goes through the solid. Each facet's plane shortens the part of the ray
// that is behind all of them.
inline bool RayHits(const Vector3& eye, const Vector3& through, const ConvexHull& solid) {
  double enters = 0;
  double leaves = 1e9;
  for (const geometry::Facet& facet : solid.facets) {
    const double height = facet.normal.dot(eye - solid.vertices[facet.loop[0]]);
    const double climb = facet.normal.dot(through - eye);
    if (climb < 0) enters = std::max(enters, -height / climb);
    if (climb > 0) leaves = std::min(leaves, -height / climb);
    if (climb == 0 && height > 0) return false;
  }
  return enters < leaves;
}

// Returns the distance of a point from a facet: from its plane, if the point is over the facet, or
// else from its nearest side.
inline double PointFacetDistance(const Vector3& p, const ConvexHull& solid,
                                 const geometry::Facet& facet) {
  bool is_over = true;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < facet.loop.size(); ++i) {
    const Vector3& a = solid.vertices[facet.loop[i]];
    const Vector3& b = solid.vertices[facet.loop[(i + 1) % facet.loop.size()]];
    is_over = is_over && facet.normal.cross(b - a).dot(p - a) >= 0;
    nearest = std::min(nearest, PointSegmentDistance(p, a, b));
  }
  return is_over ? std::abs(facet.normal.dot(p - solid.vertices[facet.loop[0]])) : nearest;
}

// Returns the distance of a point from a solid, 0 inside.
inline double PointSolidDistance(const Vector3& p, const ConvexHull& solid) {
  if (IsWithin(solid, p, 0)) return 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (const geometry::Facet& facet : solid.facets)
    nearest = std::min(nearest, PointFacetDistance(p, solid, facet));
  return nearest;
}

}  // namespace assay::oracle
