#include "planner/geometry/solids/point_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/geometry/hull.h"

namespace assay::geometry {
namespace {

// Returns the distance of a point from a facet, measured along the facet's plane.
double DistanceInPlane(const ConvexHull& hull, const Facet& facet, const Vector3& p) {
  const Vector3 on_plane = p - (facet.normal.dot(p) - facet.offset) * facet.normal;
  double least = std::numeric_limits<double>::infinity();
  bool is_inside = true;
  for (std::size_t i = 0; i < facet.loop.size(); ++i) {
    const Vector3& start = hull.vertices[facet.loop[i]];
    const Vector3 along = hull.vertices[facet.loop[(i + 1) % facet.loop.size()]] - start;
    const Vector3 to = on_plane - start;
    if (facet.normal.dot(along.cross(to)) < 0) is_inside = false;
    const double share = std::clamp(along.dot(to) / along.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (to - share * along).norm());
  }
  return is_inside ? 0 : least;
}

}  // namespace

double DistanceTo(const ConvexHull& hull, const Vector3& p) {
  if (Contains(hull, p, 0)) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (const Facet& facet : hull.facets) {
    const double height = facet.normal.dot(p) - facet.offset;
    if (height > 0) least = std::min(least, std::hypot(height, DistanceInPlane(hull, facet, p)));
  }
  return least;
}

}  // namespace assay::geometry
