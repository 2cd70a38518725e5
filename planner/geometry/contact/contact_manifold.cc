#include "planner/geometry/contact/contact_manifold.h"

#include <algorithm>

#include "planner/geometry/contact/contact_patch.h"
#include "planner/geometry/contact/separating_axis.h"

namespace assay::geometry {
namespace {

// The separation of a pair of edges counts only if it is greater than that of every facet by this,
// in metres.
constexpr double kEdgePreference = 1e-6;
// A facet of the second solid is preferred to one of the first only if its separation is greater by
// this, in metres, so that rounding does not decide between the two.
constexpr double kSecondPreference = 1e-9;

// Returns the manifold with the outermost of the points, or none if there are no points. The points
// are on one surface, and `plane` is the plane of the other one. Points and plane are given in the
// frame of `X_WorldFrame`.
std::optional<ContactManifold> ManifoldOf(const std::vector<Vector3>& points, const Plane& plane,
                                          const Pose& X_WorldFrame) {
  if (points.empty()) return std::nullopt;
  ContactManifold manifold{.normal = X_WorldFrame.linear() * plane.normal, .points = {}};
  for (const Vector3& point : Outermost(points, plane.normal, kMostContactPoints)) {
    const double separation = plane.Above(point);
    const Vector3 middle = point - separation / 2 * plane.normal;
    manifold.points.push_back({X_WorldFrame * middle, separation});
  }
  return manifold;
}

std::optional<ContactManifold> FacetContact(const ContactSolid& of, const Pose& X_WorldOf,
                                            int facet, const ContactSolid& other,
                                            const Pose& X_OfOther, double margin) {
  return ManifoldOf(CommonCorners(of, facet, other, X_OfOther, margin), of.PlaneOf(facet),
                    X_WorldOf);
}

Segment SegmentOf(const ContactSolid& solid, int edge) {
  const ContactSolid::Edge& ends = solid.edges[edge];
  return {solid.hull.vertices[ends.start], solid.hull.vertices[ends.end]};
}

// Returns the point midway between the nearest points of two crossing lines.
Vector3 Crossing(const Segment& a, const Segment& b) {
  const Vector3 u = a.end - a.start;
  const Vector3 v = b.end - b.start;
  const Vector3 w = b.start - a.start;
  const double uu = u.dot(u), vv = v.dot(v), uv = u.dot(v);
  const double determinant = uu * vv - uv * uv;
  const double s = (w.dot(u) * vv - w.dot(v) * uv) / determinant;
  const double t = (w.dot(u) * uv - w.dot(v) * uu) / determinant;
  return (a.start + s * u + b.start + t * v) / 2;
}

ContactManifold EdgeContact(const ContactSolid& a, const Pose& X_WorldA, const ContactSolid& b,
                            const Pose& X_AB, const EdgeAxis& axis) {
  Segment of_b = SegmentOf(b, axis.edge_of_b);
  of_b = {X_AB * of_b.start, X_AB * of_b.end};
  const Vector3 at = Crossing(SegmentOf(a, axis.edge_of_a), of_b);
  return {.normal = X_WorldA.linear() * axis.normal, .points = {{X_WorldA * at, axis.separation}}};
}

}  // namespace

std::optional<ContactManifold> ContactBetween(const ContactSolid& a, const Pose& X_WorldA,
                                              const ContactSolid& b, const Pose& X_WorldB,
                                              double margin) {
  const Pose X_AB = X_WorldA.inverse() * X_WorldB;
  const Pose X_BA = X_AB.inverse();
  const FacetAxis of_a = BestFacet(a, b, X_AB, margin);
  if (of_a.separation > margin) return std::nullopt;
  const FacetAxis of_b = BestFacet(b, a, X_BA, margin);
  if (of_b.separation > margin) return std::nullopt;
  const double of_facets = std::max(of_a.separation, of_b.separation);
  if (of_facets < -kEdgePreference) {
    const EdgeAxis edges = BestEdges(a, b, X_AB);
    if (edges.separation > margin) return std::nullopt;
    if (edges.separation > of_facets + kEdgePreference) {
      return EdgeContact(a, X_WorldA, b, X_AB, edges);
    }
  }
  if (of_b.separation <= of_a.separation + kSecondPreference) {
    return FacetContact(a, X_WorldA, of_a.facet, b, X_AB, margin);
  }
  auto manifold = FacetContact(b, X_WorldB, of_b.facet, a, X_BA, margin);
  if (manifold) manifold->normal = -manifold->normal;
  return manifold;
}

std::optional<ContactManifold> ContactBetween(const Plane& plane, const ContactSolid& solid,
                                              const Pose& X_WorldSolid, double margin) {
  std::vector<Vector3> points;
  for (const Vector3& vertex : solid.hull.vertices) {
    const Vector3 point = X_WorldSolid * vertex;
    if (plane.Above(point) <= margin) points.push_back(point);
  }
  return ManifoldOf(points, plane, Pose::Identity());
}

}  // namespace assay::geometry
