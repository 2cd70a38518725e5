#include "planner/geometry/solids/shadow.h"

#include <vector>

#include "planner/geometry/hull.h"
#include "planner/geometry/polygon.h"

namespace assay::geometry {

Polygon ShadowBetween(const ConvexHull& solid, double low, double high) {
  std::vector<Vector2> points;
  const auto add_crossing = [&](const Vector3& a, const Vector3& b, double height) {
    if ((a.z() < height) == (b.z() < height) || a.z() == height || b.z() == height) return;
    const double share = (height - a.z()) / (b.z() - a.z());
    points.push_back((a + share * (b - a)).head<2>());
  };
  for (const Vector3& vertex : solid.vertices) {
    if (vertex.z() >= low && vertex.z() <= high) points.push_back(vertex.head<2>());
  }
  for (const Facet& facet : solid.facets) {
    for (std::size_t i = 0; i < facet.loop.size(); ++i) {
      const int a = facet.loop[i];
      const int b = facet.loop[(i + 1) % facet.loop.size()];
      if (a > b) continue;  // the edge belongs to another facet, too
      add_crossing(solid.vertices[a], solid.vertices[b], low);
      if (high > low) add_crossing(solid.vertices[a], solid.vertices[b], high);
    }
  }
  return Hull2(points);
}

}  // namespace assay::geometry
