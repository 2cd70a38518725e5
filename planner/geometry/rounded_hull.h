#pragma once

#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "planner/geometry/coordinates.h"

namespace assay::geometry {

struct ConvexHull;

// All points within `radius` of a convex polyhedron, prepared for many distance queries. Rounded
// hulls form conservative models of convex bodies in motion.
class RoundedHull {
 public:
  // The points must span three dimensions (checked), and radius >= 0, in metres.
  explicit RoundedHull(std::span<const Vector3> points, double radius = 0);
  explicit RoundedHull(ConvexHull core, double radius = 0);

  const ConvexHull& core() const { return *core_; }  // the polyhedron without the radius
  const std::vector<Vector3>& vertices() const { return *vertices_; }
  double radius() const { return radius_; }

  // A ball that contains the rounded hull.
  const Vector3& center() const { return center_; }
  double ball_radius() const { return ball_radius_; }

  struct Prepared;
  const Prepared& prepared() const { return *prepared_; }

 private:
  std::shared_ptr<const ConvexHull> core_;
  const std::vector<Vector3>* vertices_ = nullptr;  // of the core
  double radius_ = 0;
  Vector3 center_ = Vector3::Zero();
  double ball_radius_ = 0;
  std::shared_ptr<const Prepared> prepared_;
};

// Returns a distance that the two hulls are surely apart, in metres, or 0 if they overlap or touch.
// FCL finds the nearest points. The result is the width of the slab between the hulls that is
// normal to the difference of these points. It never exceeds the distance (up to rounding),
// whatever FCL answers, and it is the distance itself if FCL's points are right. If the hulls are
// at least `enough` apart, the result may be any value of at least `enough`.
double Separation(const RoundedHull& a, const Pose& X_WorldA, const RoundedHull& b,
                  const Pose& X_WorldB, double enough = std::numeric_limits<double>::infinity());
// Computes the separation of two hulls that have moved little since the last query. A slab along
// the same direction is usually wide enough again. `slab` is that direction in A's frame, or zero
// if there was no query. It is updated.
double Separation(const RoundedHull& a, const Pose& X_WorldA, const RoundedHull& b,
                  const Pose& X_WorldB, double enough, Vector3& slab);

}  // namespace assay::geometry
