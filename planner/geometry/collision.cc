#include "planner/geometry/collision.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "planner/base/check.h"
#include "planner/geometry/narrow_phase.h"

namespace assay::geometry {
namespace {

// Rounding decides whether faces that touch exactly overlap. Therefore an overlap of up to one
// nanometre never counts.
constexpr double kTouching = 1e-9;

}  // namespace

struct Ball {
  Vector3 center;
  double radius = 0;
};

struct PreparedBox {
  Pose X_ShapeBox;
  Pose X_BoxShape;
  Vector3 half_extents;
  double radius = 0;
};

namespace {

// Returns the distance from the point to the farthest corner of the box.
double GreatestDistanceTo(const PreparedBox& box, const Vector3& p_Shape) {
  return ((box.X_BoxShape * p_Shape).cwiseAbs() + box.half_extents).norm();
}

double GreatestDistanceTo(std::span<const PreparedBox> boxes, const Vector3& p_Shape) {
  double greatest = 0;
  for (const PreparedBox& box : boxes) {
    greatest = std::max(greatest, GreatestDistanceTo(box, p_Shape));
  }
  return greatest;
}

Ball BoundingBall(std::span<const PreparedBox> boxes) {
  Eigen::AlignedBox3d bounds;
  for (const PreparedBox& box : boxes) {
    const Vector3 reach = box.X_ShapeBox.linear().cwiseAbs() * box.half_extents;
    bounds.extend(box.X_ShapeBox.translation() - reach);
    bounds.extend(box.X_ShapeBox.translation() + reach);
  }
  return {bounds.center(), GreatestDistanceTo(boxes, bounds.center())};
}

// Returns the distance of a point from a box.
double DistanceTo(const PreparedBox& box, const Vector3& p_Shape) {
  const Vector3 p_Box = box.X_BoxShape * p_Shape;
  return (p_Box.cwiseAbs() - box.half_extents).cwiseMax(0.0).norm();
}

// Returns the full edge lengths of a box whose faces are moved inward by `inset`. The box keeps a
// tiny thickness.
Vector3 ShrunkSides(const Vector3& half_extents, double inset) {
  return 2 * (half_extents.array() - inset).max(kTouching / 10).matrix();
}

bool BoxesOverlap(const PreparedBox& a, const PreparedBox& b, const Pose& X_ABox, double inset) {
  return AreOverlapping({ShrunkSides(a.half_extents, inset), a.X_ShapeBox},
                        {ShrunkSides(b.half_extents, inset), X_ABox});
}

double BoxDistance(const PreparedBox& a, const PreparedBox& b, const Pose& X_ABox) {
  return std::max(
      0.0, Distance(PlacedBox{2 * a.half_extents, a.X_ShapeBox}, {2 * b.half_extents, X_ABox}));
}

}  // namespace

struct CollisionShape::Prepared {
  std::vector<PreparedBox> boxes;
  Ball ball;
};

CollisionShape::CollisionShape(std::span<const Box> boxes) {
  auto prepared = std::make_shared<Prepared>();
  prepared->boxes.reserve(boxes.size());
  for (const Box& box : boxes) {
    prepared->boxes.push_back(
        {box.X_FrameBox, box.X_FrameBox.inverse(), box.half_extents, box.half_extents.norm()});
  }
  radius_ = GreatestDistanceTo(prepared->boxes, Vector3::Zero());
  if (!boxes.empty()) prepared->ball = BoundingBall(prepared->boxes);
  prepared_ = std::move(prepared);
}

bool Overlaps(const CollisionShape& a, const Pose& X_WorldA, const CollisionShape& b,
              const Pose& X_WorldB, double allowance) {
  ASSAY_CHECK(allowance >= 0);
  const Ball& a_ball = a.prepared().ball;
  const Ball& b_ball = b.prepared().ball;
  const double apart = (X_WorldA * a_ball.center - X_WorldB * b_ball.center).norm();
  if (apart > a_ball.radius + b_ball.radius) return false;
  const Pose X_AB = X_WorldA.inverse() * X_WorldB;
  const double inset = (allowance + kTouching) / 2;
  for (const PreparedBox& b_box : b.prepared().boxes) {
    const Vector3 center = X_AB * b_box.X_ShapeBox.translation();
    if ((center - a_ball.center).norm() > a_ball.radius + b_box.radius) continue;
    const Pose X_ABox = X_AB * b_box.X_ShapeBox;
    for (const PreparedBox& a_box : a.prepared().boxes) {
      if (DistanceTo(a_box, center) > b_box.radius) continue;
      if (BoxesOverlap(a_box, b_box, X_ABox, inset)) return true;
    }
  }
  return false;
}

double Distance(const CollisionShape& a, const Pose& X_WorldA, const CollisionShape& b,
                const Pose& X_WorldB) {
  if (Overlaps(a, X_WorldA, b, X_WorldB, 0)) return 0;
  const Pose X_AB = X_WorldA.inverse() * X_WorldB;
  double least = std::numeric_limits<double>::infinity();
  for (const PreparedBox& b_box : b.prepared().boxes) {
    const Pose X_ABox = X_AB * b_box.X_ShapeBox;
    for (const PreparedBox& a_box : a.prepared().boxes) {
      if (DistanceTo(a_box, X_ABox.translation()) - b_box.radius >= least) continue;
      least = std::min(least, BoxDistance(a_box, b_box, X_ABox));
    }
  }
  return least;
}

}  // namespace assay::geometry
