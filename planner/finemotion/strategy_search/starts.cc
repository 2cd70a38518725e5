#include "planner/finemotion/strategy_search/starts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace assay::finemotion {

namespace {

constexpr double kAbove = 0.002;  // metres between a start and all that errors can bring near
// Every start is tilted by more than this angle, in radians, so that no edges are parallel.
constexpr double kLeastTilt = 0.035;
constexpr double kLeastInside = 1e-3;  // metres by which the lowest corner is inside the entry

}  // namespace

Start Starts::Upright() const {
  return {.turn = Vector3::Zero(), .beside = kLeastInside * passage_.mating.unitOrthogonal()};
}

Start Starts::Random() {
  const Vector3& in = passage_.mating;
  const Vector3 side = in.unitOrthogonal();
  const Vector3 other = in.cross(side);
  Start start;
  start.turn = random_.Uniform(-options_.twist, options_.twist) * in;
  for (const Vector3& axis : {side, other}) {
    const double tilt = random_.Uniform(-1, 1);
    const double most = std::max(kLeastTilt, options_.tilt);
    start.turn += std::copysign(std::lerp(kLeastTilt, most, std::abs(tilt)), tilt) * axis;
  }
  const Vector3 corner = LowestCorner(start.turn);
  for (const Vector3& axis : {side, other}) {
    const double inside = random_.Uniform(kLeastInside, options_.offset);
    start.beside -= std::copysign(inside, corner.dot(axis)) * axis;
  }
  return start;
}

Start Starts::Near(const Start& start, double size) {
  const auto within = [&](double most) { return random_.Uniform(-most, most) * size; };
  const Vector3& in = passage_.mating;
  const Vector3 side = in.unitOrthogonal();
  const Vector3 other = in.cross(side);
  Start near = start;
  near.turn +=
      within(options_.twist) * in + within(options_.tilt) * side + within(options_.tilt) * other;
  near.beside += within(options_.offset) * side + within(options_.offset) * other;
  return near;
}

BelievedPose Starts::BelievedPoseAt(const Start& start, double multiple) const {
  constexpr double kAnyLever = std::numeric_limits<double>::infinity();
  const Pose X_StationaryEntered = Entered(start);
  const double height = std::max(Deepest(X_StationaryEntered, 1, options_.reach) + kAbove,
                                 Deepest(X_StationaryEntered, multiple, kAnyLever));
  BelievedPose believed = BelievedPoseIn(X_StationaryEntered, errors_, multiple);
  believed.X_StationaryMoving.translation() -= height * passage_.mating;
  return believed;
}

Pose Starts::Entered(const Start& start) const {
  PoseChange z;
  z << start.beside, start.turn;
  return Displaced(passage_.X_StationaryEntry, z);
}

double Starts::Deepest(const Pose& X_StationaryMoving, double multiple, double lever) const {
  double deepest = 0;
  for (const OuterVertex& vertex : passage_.moving.vertices) {
    const Vector3 at = X_StationaryMoving * vertex.p;
    const double depth = (at - passage_.X_StationaryEntry.translation()).dot(passage_.mating);
    const double nearer = errors_.pose.head<3>().norm() +
                          errors_.pose.tail<3>().norm() * std::min(vertex.p.norm(), lever) +
                          errors_.tolerances.sum();
    deepest = std::max(deepest, depth + multiple * nearer);
  }
  return deepest;
}

Vector3 Starts::LowestCorner(const Vector3& turn) const {
  const Pose X = Entered({.turn = turn});
  Vector3 lowest = Vector3::Zero();
  for (const OuterVertex& vertex : passage_.moving.vertices) {
    const Vector3 at = X.linear() * vertex.p;
    if (at.dot(passage_.mating) > lowest.dot(passage_.mating)) lowest = at;
  }
  return lowest;
}

}  // namespace assay::finemotion
