#pragma once

#include <memory>
#include <span>

#include "planner/geometry/coordinates.h"

namespace assay::geometry {

struct Box;
struct ConvexHull;

// A rigid union of convex solids, prepared for many overlap and distance queries.
class CollisionShape {
 public:
  CollisionShape() : CollisionShape(std::span<const ConvexHull>()) {}  // an empty shape
  explicit CollisionShape(std::span<const ConvexHull> solids);
  explicit CollisionShape(std::span<const Box> boxes);

  // The radius of a ball about the frame's origin that contains the shape.
  double radius() const { return radius_; }

  struct Prepared;
  const Prepared& prepared() const { return *prepared_; }

 private:
  std::shared_ptr<const Prepared> prepared_;
  double radius_ = 0;
};

// Returns true if the shapes overlap by more than `allowance` metres. Faces that touch, or that
// overlap by less, do not count. The allowance must be >= 0. One nanometre is added to it, so that
// rounding does not decide whether touching faces overlap. Each face of every solid is moved inward
// by half the allowance, and a thinner box keeps a small thickness. Edges and corners therefore
// have to overlap by more: those of a box by up to sqrt(3) times as much.
bool Overlaps(const CollisionShape& a, const Pose& X_WorldA, const CollisionShape& b,
              const Pose& X_WorldB, double allowance);

// Returns the least distance between the shapes, to about 0.1 micrometres, or 0 if they overlap. It
// is infinite if a shape is empty.
double Distance(const CollisionShape& a, const Pose& X_WorldA, const CollisionShape& b,
                const Pose& X_WorldB);

}  // namespace assay::geometry
