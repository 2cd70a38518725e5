#include "planner/geometry/solids/separation.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "planner/geometry/hull.h"

namespace assay::geometry {
namespace {

constexpr double kParallelEdges = 1e-9;  // sine of the angle between edges that count as parallel

double GapAlong(const ConvexHull& a, const ConvexHull& b, const Vector3& axis) {
  return std::max(-GreatestAlong(b, -axis) - GreatestAlong(a, axis),
                  -GreatestAlong(a, -axis) - GreatestAlong(b, axis));
}

}  // namespace

double Separation(const ConvexHull& a, const ConvexHull& b) {
  double gap = -std::numeric_limits<double>::infinity();
  for (const ConvexHull* const solid : {&a, &b}) {
    for (const Facet& facet : solid->facets) gap = std::max(gap, GapAlong(a, b, facet.normal));
  }
  const std::vector<Vector3> edges_of_b = EdgeDirections(b);
  for (const Vector3& of_a : EdgeDirections(a)) {
    for (const Vector3& of_b : edges_of_b) {
      const Vector3 cross = of_a.cross(of_b);
      // Parallel edges are skipped, because their common normals are normals of facets.
      if (cross.norm() > kParallelEdges) gap = std::max(gap, GapAlong(a, b, cross.normalized()));
    }
  }
  return gap;
}

double OverlapDepth(std::span<const ConvexHull> a, std::span<const ConvexHull> b) {
  std::vector<Ball> balls_of_b;
  for (const ConvexHull& solid : b) balls_of_b.push_back(BallAround(solid.vertices));
  double depth = 0;
  for (const ConvexHull& of_a : a) {
    const Ball ball = BallAround(of_a.vertices);
    for (std::size_t i = 0; i < b.size(); ++i) {
      const double between = (balls_of_b[i].center - ball.center).norm();
      if (between >= ball.radius + balls_of_b[i].radius) continue;
      depth = std::max(depth, -Separation(of_a, b[i]));
    }
  }
  return depth;
}

}  // namespace assay::geometry
