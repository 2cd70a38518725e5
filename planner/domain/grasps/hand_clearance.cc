#include "planner/domain/grasps/hand_clearance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/geometry/box.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/solids/shadow.h"

namespace assay::domain {

using geometry::Box;

bool CObstacle::Contains(const Vector2& p) const {
  return std::ranges::all_of(sides, [&](const Side& s) { return s.normal.dot(p) < s.offset; });
}

Approach Approach::At(double angle, double length) {
  const Vector2 z(std::cos(angle), std::sin(angle));
  return {.x = Vector2(-z.y(), z.x()), .z = z, .length = length};  // x = y cross z
}

HandClearance::HandClearance(const PartModel& part, const kinematics::Gripper& gripper,
                             const Pose& X_PartMiddle, double width, double allowance) {
  pieces_ = Transformed(part.pieces(), X_PartMiddle.inverse());
  Add(gripper.HandBoxes(), Stage::kApproaching, allowance);
  if (width > gripper.max_opening()) return;
  Add(gripper.FingerBoxes(gripper.max_opening()), Stage::kApproaching, allowance);
  Add(gripper.FingerBoxes(width), Stage::kClosed, allowance);
}

void HandClearance::Add(const std::vector<Box>& gripper_boxes, Stage stage, double allowance) {
  for (const Box& box : gripper_boxes) {
    Eigen::AlignedBox3d bounds;  // in the tool frame
    for (const Vector3& corner : box.Corners()) bounds.extend(corner);
    const Vector3 low = bounds.min().array() + allowance;
    const Vector3 high = bounds.max().array() - allowance;
    if ((low.array() >= high.array()).any()) continue;
    for (const geometry::ConvexHull& piece : pieces_) {
      geometry::Polygon shadow = geometry::ShadowBetween(piece, low.y(), high.y());
      if (shadow.size() < 3) continue;
      encounters_.push_back({stage, {low.x(), low.z()}, {high.x(), high.z()}, std::move(shadow)});
    }
  }
}

std::vector<CObstacle> HandClearance::ObstaclesOf(const Approach& approach) const {
  std::vector<CObstacle> obstacles;
  for (const Encounter& encounter : encounters_) {
    obstacles.push_back(ObstacleOf(encounter, approach));
  }
  return obstacles;
}

// The Minkowski sum of the shadow and the reflected rectangle has the edge normals of both
// polygons. The straight approach stretches the rectangle backward.
CObstacle HandClearance::ObstacleOf(const Encounter& encounter, const Approach& approach) {
  Vector2 low = encounter.low;
  if (encounter.stage == Stage::kApproaching) low.y() -= approach.length;
  CObstacle obstacle;
  const auto add = [&](const Vector2& normal) {
    double farthest = -std::numeric_limits<double>::infinity();
    for (const Vector2& p : encounter.shadow) farthest = std::max(farthest, normal.dot(p));
    const Vector2 seen(normal.dot(approach.x), normal.dot(approach.z));  // in tool axes
    const double nearest = seen.cwiseProduct(low).cwiseMin(seen.cwiseProduct(encounter.high)).sum();
    obstacle.sides.push_back({normal, farthest - nearest});
  };
  for (const Vector2& axis : {approach.x, approach.z}) {
    add(axis);
    add(-axis);
  }
  for (std::size_t i = 0; i < encounter.shadow.size(); ++i) {
    const Vector2 edge = encounter.shadow[(i + 1) % encounter.shadow.size()] - encounter.shadow[i];
    add(Vector2(edge.y(), -edge.x()));
  }
  return obstacle;
}

}  // namespace assay::domain
