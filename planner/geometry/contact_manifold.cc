#include "planner/geometry/contact_manifold.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "planner/geometry/outline.h"

namespace assay::geometry {
namespace {

// Metres by which a pair of edges must be better than a facet. Rounding must not decide between
// them.
constexpr double kPreference = 1e-6;
constexpr double kParallel = 1e-6;  // sine of the angle between directions that count as parallel

// A solid's vertices and directions in the frame in which both solids are compared.
class Placed {
 public:
  Placed(const ContactSolid& solid, const Pose& X) : solid_(&solid), X_(X) {
    vertices_.reserve(solid.hull.vertices.size());
    for (const Vector3& vertex : solid.hull.vertices) vertices_.push_back(X * vertex);
  }

  const ContactSolid& solid() const { return *solid_; }
  const std::vector<Vector3>& vertices() const { return vertices_; }
  Vector3 Direction(std::size_t i) const { return X_.linear() * solid_->directions[i]; }
  Plane PlaneOf(std::size_t facet) const {
    const Facet& own = solid_->hull.facets[facet];
    const Vector3 normal = X_.linear() * own.normal;
    return {normal, own.offset + normal.dot(X_.translation())};
  }
  Outline OutlineOf(std::size_t facet) const {
    Outline outline;
    for (const int vertex : solid_->hull.facets[facet].loop) outline.push_back(vertices_[vertex]);
    return outline;
  }

  double Lowest(const Vector3& along) const {
    double lowest = std::numeric_limits<double>::infinity();
    for (const Vector3& vertex : vertices_) lowest = std::min(lowest, along.dot(vertex));
    return lowest;
  }
  double Highest(const Vector3& along) const { return -Lowest(-along); }

  // Returns the facet whose normal is most along a direction.
  std::size_t FacetTowards(const Vector3& direction) const {
    const Vector3 own = X_.linear().transpose() * direction;
    const auto& facets = solid_->hull.facets;
    const auto best =
        std::ranges::max_element(facets, {}, [&](const Facet& f) { return f.normal.dot(own); });
    return static_cast<std::size_t>(best - facets.begin());
  }

  // Returns the edge farthest along `normal` among those parallel to a direction.
  Segment EdgeTowards(const Vector3& normal, const Vector3& direction) const {
    Segment best{Vector3::Zero(), Vector3::Zero()};
    double farthest = -std::numeric_limits<double>::infinity();
    for (const ContactSolid::Edge& edge : solid_->edges) {
      const Segment segment{vertices_[edge.start], vertices_[edge.end]};
      const Vector3 along = (segment.end - segment.start).normalized();
      if (along.cross(direction).norm() > kParallel) continue;
      const double reach = normal.dot(segment.Middle());
      if (reach <= farthest) continue;
      farthest = reach;
      best = segment;
    }
    return best;
  }

 private:
  const ContactSolid* solid_;
  const Pose& X_;
  std::vector<Vector3> vertices_;
};

// The best axis found so far: the one with the greatest separation.
struct FacetAxis {
  double separation = -std::numeric_limits<double>::infinity();
  std::size_t facet = 0;
};
struct EdgeAxis {
  double separation = -std::numeric_limits<double>::infinity();
  Vector3 normal = Vector3::Zero();  // from a to b
  Vector3 along_a = Vector3::Zero();
  Vector3 along_b = Vector3::Zero();
};

FacetAxis BestFacet(const Placed& of, const Placed& other, double margin) {
  FacetAxis best;
  for (std::size_t i = 0; i < of.solid().hull.facets.size(); ++i) {
    const Plane plane = of.PlaneOf(i);
    const double separation = other.Lowest(plane.normal) - plane.height;
    if (separation > best.separation) best = {separation, i};
    if (separation > margin) break;
  }
  return best;
}

EdgeAxis BestEdges(const Placed& a, const Placed& b, double margin) {
  EdgeAxis best;
  for (std::size_t i = 0; i < a.solid().directions.size(); ++i) {
    const Vector3 along_a = a.Direction(i);
    for (std::size_t j = 0; j < b.solid().directions.size(); ++j) {
      const Vector3 along_b = b.Direction(j);
      Vector3 normal = along_a.cross(along_b);
      if (normal.norm() < kParallel) continue;
      normal.normalize();
      for (const Vector3& n : {normal, Vector3(-normal)}) {
        const double separation = b.Lowest(n) - a.Highest(n);
        if (separation > best.separation) best = {separation, n, along_a, along_b};
      }
      if (best.separation > margin) return best;
    }
  }
  return best;
}

// Returns the corners of the area that a facet of `other` has in common with a facet of `of`, where
// they are at most `margin` apart.
ContactManifold FacetContact(const Placed& of, std::size_t facet, const Placed& other,
                             double margin) {
  const Plane plane = of.PlaneOf(facet);
  const Outline own = of.OutlineOf(facet);
  Outline common = other.OutlineOf(other.FacetTowards(-plane.normal));
  for (std::size_t i = 0; i < own.size() && !common.empty(); ++i) {
    const Vector3 inward = plane.normal.cross(own[(i + 1) % own.size()] - own[i]).normalized();
    common = Split(common, {-inward, -inward.dot(own[i])}, 0).below;
  }
  ContactManifold manifold{.normal = plane.normal, .points = {}};
  for (const Vector3& corner : common) {
    const double separation = plane.Above(corner);
    if (separation > margin) continue;
    manifold.points.push_back({corner - separation / 2 * plane.normal, separation});
  }
  return manifold;
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

ContactManifold EdgeContact(const Placed& a, const Placed& b, const EdgeAxis& axis) {
  const Vector3 at =
      Crossing(a.EdgeTowards(axis.normal, axis.along_a), b.EdgeTowards(-axis.normal, axis.along_b));
  return {.normal = axis.normal, .points = {{at, axis.separation}}};
}

}  // namespace

ContactSolid::ContactSolid(ConvexHull solid) : hull(std::move(solid)) {
  for (const Facet& facet : hull.facets) {
    for (std::size_t i = 0; i < facet.loop.size(); ++i) {
      const Edge edge{facet.loop[i], facet.loop[(i + 1) % facet.loop.size()]};
      if (edge.start > edge.end) continue;  // the neighbouring facet has it, too
      edges.push_back(edge);
      const Vector3 along = (hull.vertices[edge.end] - hull.vertices[edge.start]).normalized();
      const auto same = [&](const Vector3& d) { return d.cross(along).norm() < kParallel; };
      if (std::ranges::none_of(directions, same)) directions.push_back(along);
    }
  }
}

std::optional<ContactManifold> ContactBetween(const ContactSolid& a, const Pose& X_WorldA,
                                              const ContactSolid& b, const Pose& X_WorldB,
                                              double margin) {
  const Placed in_a(a, X_WorldA);
  const Placed in_b(b, X_WorldB);
  const FacetAxis of_a = BestFacet(in_a, in_b, margin);
  if (of_a.separation > margin) return std::nullopt;
  const FacetAxis of_b = BestFacet(in_b, in_a, margin);
  if (of_b.separation > margin) return std::nullopt;
  const EdgeAxis edges = BestEdges(in_a, in_b, margin);
  if (edges.separation > margin) return std::nullopt;
  if (edges.separation > std::max(of_a.separation, of_b.separation) + kPreference) {
    return EdgeContact(in_a, in_b, edges);
  }
  if (of_a.separation >= of_b.separation - kPreference) {
    return FacetContact(in_a, of_a.facet, in_b, margin);
  }
  ContactManifold manifold = FacetContact(in_b, of_b.facet, in_a, margin);
  manifold.normal = -manifold.normal;
  return manifold;
}

}  // namespace assay::geometry
