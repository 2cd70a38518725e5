#include "planner/geometry/box_shadow.h"

#include <vector>

namespace assay::geometry {
namespace {

// Appends the point where the edge from p to q passes through the plane z = height, if it does.
void AppendCrossing(const Vector3& p, const Vector3& q, double height,
                    std::vector<Vector2>& points) {
  const double below = height - p.z();
  const double above = q.z() - height;
  if (below * above <= 0) return;
  points.push_back((p + below / (below + above) * (q - p)).head<2>());
}

}  // namespace

Polygon ShadowBetween(const Box& box, double low, double high) {
  // Bit k of the index is the side along axis k.
  const std::array<Vector3, 8> corners = box.Corners();
  std::vector<Vector2> points;
  for (int i = 0; i < 8; ++i) {
    if (corners[i].z() >= low && corners[i].z() <= high) points.push_back(corners[i].head<2>());
    for (int bit = 1; bit < 8; bit *= 2) {
      if ((i & bit) != 0) continue;
      AppendCrossing(corners[i], corners[i | bit], low, points);
      if (high > low) AppendCrossing(corners[i], corners[i | bit], high, points);
    }
  }
  return Hull2(points);
}

}  // namespace assay::geometry
