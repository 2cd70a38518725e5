#pragma once

#include <memory>
#include <span>

#include "planner/geometry/box.h"

namespace assay::geometry {

// A rigid union of boxes, prepared for many overlap and distance queries.
class CollisionShape {
 public:
  explicit CollisionShape(std::span<const Box> boxes);

  // The radius of a ball about the frame's origin that holds the shape.
  double radius() const { return radius_; }

  struct Prepared;
  const Prepared& prepared() const { return *prepared_; }

 private:
  std::shared_ptr<const Prepared> prepared_;
  double radius_ = 0;
};

// Whether the shapes overlap by more than `allowance` metres: faces that touch, or that overlap
// less than this, do not count. allowance >= 0. A nanometre is added to it, so that rounding does
// not decide whether faces that touch overlap. Every box loses half of it on each face (one that
// is thinner keeps a sheet): edges and corners have to overlap by up to sqrt(3) times as much.
bool Overlaps(const CollisionShape& a, const Pose& X_WorldA, const CollisionShape& b,
              const Pose& X_WorldB, double allowance);

// The least distance between the shapes, 0 if they overlap; to about 0.1 micrometres. Infinite if
// a shape has no boxes.
double Distance(const CollisionShape& a, const Pose& X_WorldA, const CollisionShape& b,
                const Pose& X_WorldB);

}  // namespace assay::geometry
