#include "planner/geometry/solids/connected_solids.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "planner/geometry/hull.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/pose.h"
#include "planner/geometry/solids/convex_cut.h"

namespace assay::geometry {
namespace {

constexpr double kFacetsTouch = 1e-6;    // metres between facets that touch
constexpr double kFacing = 1e-6;         // length of the sum of opposite unit normals
constexpr double kLeastContact = 1e-11;  // area of a contact that holds, square metres

Polygon InPlane(const ConvexHull& solid, const Facet& facet, const Pose& X_PlaneSolid) {
  std::vector<Vector2> corners;
  for (const int vertex : facet.loop) {
    corners.push_back((X_PlaneSolid * solid.vertices[vertex]).head<2>());
  }
  return Hull2(corners);
}

bool Touch(const ConvexHull& a, const ConvexHull& b) {
  for (const Facet& of_a : a.facets) {
    for (const Facet& of_b : b.facets) {
      if ((of_a.normal + of_b.normal).norm() > kFacing) continue;
      if (std::abs(of_a.offset + of_b.offset) > kFacetsTouch) continue;
      const Vector3 x = of_a.normal.unitOrthogonal();
      const Pose X_PlaneSolid =
          PoseFromColumns(x, of_a.normal.cross(x), of_a.normal, Vector3::Zero()).inverse();
      const Polygon common =
          Intersection(InPlane(a, of_a, X_PlaneSolid), InPlane(b, of_b, X_PlaneSolid));
      if (Area(common) > kLeastContact) return true;
    }
  }
  return false;
}

bool AreConnected(const ConvexHull& a, const ConvexHull& b) {
  const Ball ball_of_a = BallAround(a.vertices);
  const Ball ball_of_b = BallAround(b.vertices);
  const double between = (ball_of_a.center - ball_of_b.center).norm();
  if (between > ball_of_a.radius + ball_of_b.radius + kFacetsTouch) return false;
  const std::optional<ConvexHull> core = Inset(b, kFacetsTouch);
  return Touch(a, b) || (core && Intersection(a, *core));
}

}  // namespace

int FirstApart(std::span<const ConvexHull> solids) {
  std::vector<bool> is_reached(solids.size());
  std::vector<std::size_t> to_look_from = {0};
  is_reached[0] = true;
  while (!to_look_from.empty()) {
    const ConvexHull& from = solids[to_look_from.back()];
    to_look_from.pop_back();
    for (std::size_t i = 0; i < solids.size(); ++i) {
      if (is_reached[i] || !AreConnected(from, solids[i])) continue;
      is_reached[i] = true;
      to_look_from.push_back(i);
    }
  }
  const auto apart = std::ranges::find(is_reached, false);
  return apart == is_reached.end() ? -1 : static_cast<int>(apart - is_reached.begin());
}

}  // namespace assay::geometry
