#pragma once

#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "planner/geometry/hull.h"
#include "planner/geometry/pose.h"

namespace assay::geometry {

// All points within `radius` of a convex polyhedron: what a conservative model of a convex body
// that moves is made of. Prepared for many queries of distance.
class RoundedHull {
 public:
  // The points must span three dimensions (checked), radius >= 0.
  explicit RoundedHull(std::span<const Vector3> points, double radius = 0)
      : RoundedHull(HullOf(points), radius) {}
  explicit RoundedHull(ConvexHull core, double radius = 0);

  const ConvexHull& core() const { return core_; }  // without the radius
  const std::vector<Vector3>& vertices() const { return core_.vertices; }
  double radius() const { return radius_; }

  // A ball that holds it all.
  const Vector3& center() const { return center_; }
  double ball_radius() const { return ball_radius_; }

  struct Prepared;
  const Prepared& prepared() const { return *prepared_; }

 private:
  ConvexHull core_;
  double radius_ = 0;
  Vector3 center_ = Vector3::Zero();
  double ball_radius_ = 0;
  std::shared_ptr<const Prepared> prepared_;
};

double Volume(const ConvexHull& hull);

// A distance that the two surely have, 0 if they overlap or touch. The nearest points are FCL's,
// but what is told is the width of the slab between the two that is normal to their difference:
// never more than the distance (up to rounding), whatever FCL answers, and the distance itself
// where its points are right. From `enough` on, anything that is at least `enough` may be told.
double Separation(const RoundedHull& a, const Pose& X_WorldA, const RoundedHull& b,
                  const Pose& X_WorldB, double enough = std::numeric_limits<double>::infinity());
// The same, for two that have moved little since the last query: a slab along the same direction is
// mostly wide enough again. `slab`: the direction, in A's frame; zero if there was no query.
double Separation(const RoundedHull& a, const Pose& X_WorldA, const RoundedHull& b,
                  const Pose& X_WorldB, double enough, Vector3& slab);

}  // namespace assay::geometry
