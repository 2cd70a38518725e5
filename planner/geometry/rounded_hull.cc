#include "planner/geometry/rounded_hull.h"

#include <algorithm>
#include <limits>
#include <mutex>

#include "planner/base/check.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/narrow_phase.h"

namespace assay::geometry {

// Created on first use, because most hulls are never near enough to another one for the nearest
// points to matter.
struct RoundedHull::Prepared {
  mutable std::once_flag made;
  mutable std::shared_ptr<const GjkHull> hull;
};

namespace {

const GjkHull& GjkHullOf(const RoundedHull& hull) {
  const RoundedHull::Prepared& prepared = hull.prepared();
  std::call_once(prepared.made, [&] { prepared.hull = MakeGjkHull(hull.core()); });
  return *prepared.hull;
}

// Returns the width of the empty slab normal to `direction`, a unit vector in A's frame from A to
// B. It is negative if the cores overlap along the direction.
double SlabWidth(const Vector3& direction, const RoundedHull& a, const RoundedHull& b,
                 const Pose& X_AB) {
  const Vector3 direction_B = X_AB.linear().transpose() * direction;
  return direction.dot(X_AB.translation()) - GreatestAlong(b.core(), -direction_B) -
         GreatestAlong(a.core(), direction);
}

// Returns the outward normal of the facet whose plane p lies farthest beyond.
const Vector3& NormalTowards(const Vector3& p, const ConvexHull& hull) {
  const auto beyond = [&](const Facet& facet) { return facet.normal.dot(p) - facet.offset; };
  return std::ranges::max_element(hull.facets, {}, beyond)->normal;
}

// Returns true if an empty slab of at least this width is found without the nearest points. `slab`
// is then its direction.
bool IsSeenApart(const RoundedHull& a, const RoundedHull& b, const Pose& X_AB, double width,
                 Vector3& slab) {
  const auto is_enough = [&](const Vector3& direction) {
    if (SlabWidth(direction, a, b, X_AB) < width) return false;
    slab = direction;
    return true;
  };
  if (!slab.isZero(0) && is_enough(slab)) return true;
  const Vector3 b_center = X_AB * b.center();
  const Vector3 a_center_B = X_AB.inverse() * a.center();
  return is_enough((b_center - a.center()).normalized()) ||
         is_enough(NormalTowards(b_center, a.core())) ||
         is_enough(-(X_AB.linear() * NormalTowards(a_center_B, b.core())));
}

const Vector3& FarthestAlong(const Vector3& direction, const ConvexHull& hull) {
  return *std::ranges::max_element(hull.vertices, {},
                                   [&](const Vector3& vertex) { return direction.dot(vertex); });
}

// Returns the direction of the widest empty slab of two kinds: the slabs normal to a facet, and the
// slab normal to `difference`, the difference of GJK's nearest points. The difference is zero if
// GJK says that the hulls overlap, and then there is no slab of the second kind. GJK may stop short
// where facets are nearly parallel, or say that hulls overlap where they do not. A slab normal to a
// facet is no wider than the distance of any point of the other hull from the facet's plane.
Vector3 WidestSlab(const RoundedHull& a, const RoundedHull& b, const Pose& X_AB,
                   const Vector3& difference) {
  const Pose X_BA = X_AB.inverse();
  const bool is_apart = !difference.isZero(0);
  Vector3 widest = is_apart ? difference.normalized() : a.core().facets.front().normal;
  double width = SlabWidth(widest, a, b, X_AB);
  const auto note = [&](const Vector3& direction) {
    const double found = SlabWidth(direction, a, b, X_AB);
    if (found <= width) return;
    width = found;
    widest = direction;
  };
  const Vector3 of_a = X_BA * FarthestAlong(widest, a.core());
  const Vector3 of_b = X_AB * FarthestAlong(-(X_BA.linear() * widest), b.core());
  for (const Facet& facet : a.core().facets) {
    if (facet.normal.dot(of_b) - facet.offset > width) note(facet.normal);
  }
  for (const Facet& facet : b.core().facets) {
    if (facet.normal.dot(of_a) - facet.offset > width) note(-(X_AB.linear() * facet.normal));
  }
  return widest;
}

}  // namespace

RoundedHull::RoundedHull(std::span<const Vector3> points, double radius)
    : RoundedHull(HullOf(points), radius) {}

RoundedHull::RoundedHull(ConvexHull core, double radius)
    : core_(std::make_shared<const ConvexHull>(std::move(core))),
      vertices_(&core_->vertices),
      radius_(radius) {
  ASSAY_CHECK(radius >= 0);
  Eigen::AlignedBox3d bounds;
  for (const Vector3& vertex : core_->vertices) bounds.extend(vertex);
  center_ = bounds.center();
  for (const Vector3& vertex : core_->vertices) {
    ball_radius_ = std::max(ball_radius_, (vertex - center_).norm() + radius);
  }
  prepared_ = std::make_shared<const Prepared>();
}

double Separation(const RoundedHull& a, const Pose& X_WorldA, const RoundedHull& b,
                  const Pose& X_WorldB, double enough) {
  Vector3 slab = Vector3::Zero();
  return Separation(a, X_WorldA, b, X_WorldB, enough, slab);
}

double Separation(const RoundedHull& a, const Pose& X_WorldA, const RoundedHull& b,
                  const Pose& X_WorldB, double enough, Vector3& slab) {
  const Pose X_AB = X_WorldA.inverse() * X_WorldB;
  if (IsSeenApart(a, b, X_AB, enough + a.radius() + b.radius(), slab)) return enough;
  const Vector3 difference = NearestDifference(GjkHullOf(a), GjkHullOf(b), X_AB);
  slab = WidestSlab(a, b, X_AB, difference);
  return std::max(0.0, SlabWidth(slab, a, b, X_AB) - a.radius() - b.radius());
}

}  // namespace assay::geometry
