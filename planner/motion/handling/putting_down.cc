#include "planner/motion/handling/putting_down.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "planner/domain/reachability/action_ways.h"
#include "planner/domain/reachability/reachability.h"
#include "planner/domain/resting/resting.h"
#include "planner/geometry/collision.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/pose.h"
#include "planner/plan/data/tool_route.h"

namespace assay::motion {
namespace {

using geometry::Vector2;

constexpr int kTurns = 8;             // turns about the vertical that are tried at each spot
constexpr double kPlacePitch = 0.05;  // metres between tried spots of a table
constexpr double kPlaceRoom = 0.06;   // metres between parts, room for fingers that open
constexpr double kSpotPitch = 0.10;   // metres between spots of a place
constexpr double kSpotRoom = 0.025;   // metres between parts, room for errors and opening fingers

// Returns the pose turned in all tried ways, with the part's origin over the spot.
std::array<Pose, kTurns> TurnedAt(const Vector2& spot, const Pose& X_WorldBelow) {
  std::array<Pose, kTurns> poses;
  for (int i = 0; i < kTurns; ++i) {
    Pose& pose = poses[static_cast<std::size_t>(i)];
    pose = geometry::RotationZ(2 * std::numbers::pi * i / kTurns) * X_WorldBelow;
    pose.translation() << spot, X_WorldBelow.translation().z();
  }
  return poses;
}

// Returns spots of the table, those nearest to its middle first.
std::vector<Vector2> SpotsOf(const domain::Table& table) {
  Eigen::AlignedBox2d box;
  for (const Vector2& corner : table.top) box.extend(corner);
  const Eigen::Vector2i steps = (box.sizes() / 2 / kPlacePitch).cast<int>();
  std::vector<Vector2> spots;
  for (int i = -steps.x(); i <= steps.x(); ++i) {
    for (int k = -steps.y(); k <= steps.y(); ++k) {
      spots.emplace_back(box.center() + kPlacePitch * Vector2(i, k));
    }
  }
  const auto squared = [&](const Vector2& p) {
    return std::round((p - box.center()).squaredNorm() / (kPlacePitch * kPlacePitch));
  };
  std::ranges::stable_sort(spots, {}, squared);
  return spots;
}

// Returns the spots of a place: its middle first, then a ring around the middle.
std::vector<Vector2> SpotsOf(const domain::Place& place) {
  const Vector2 middle(place.middle.x, place.middle.y);
  std::vector<Vector2> spots = {middle};
  if (place.radius <= kSpotPitch) return spots;
  for (int i = 0; i < 6; ++i) {
    const double angle = place.middle.yaw + i * std::numbers::pi / 3;
    spots.emplace_back(middle + kSpotPitch * Vector2(std::cos(angle), std::sin(angle)));
  }
  return spots;
}

// Returns whether the footprint of the held part at X_WorldPart has room between the others.
bool HasRoom(const domain::Problem& problem, const Surroundings& surroundings,
             const Pose& X_WorldPart) {
  const geometry::Polygon footprint =
      domain::Footprint(problem.part(surroundings.held->part), X_WorldPart);
  return std::ranges::all_of(surroundings.parts, [&](const domain::PlacedPart& other) {
    const geometry::Polygon beside = domain::Footprint(problem.part(other.part), other.X_WorldPart);
    return geometry::Gap(footprint, beside) > kPlaceRoom;
  });
}

// Returns whether the arm can release the held part at X_WorldPart and retreat.
bool CanRelease(const domain::Problem& problem, const Surroundings& surroundings,
                const Pose& X_WorldPart) {
  const domain::Part& part = problem.part(surroundings.held->part);
  for (const domain::PlacedPart& other : surroundings.parts) {
    const double gap = Distance(part.model->shape(), X_WorldPart,
                                problem.part(other.part).model->shape(), other.X_WorldPart);
    if (gap < kSpotRoom) return false;
  }
  const domain::Workcell& workcell = *problem.workcell;
  const Pose X_WorldTool = X_WorldPart * surroundings.held->X_PartTool;
  const Pose retreated = plan::Retreated(workcell, X_WorldTool);
  const double open = workcell.gripper().max_opening();
  const Vector3 lowered =
      X_WorldTool.translation() - plan::AtSafeHeight(workcell, X_WorldTool).translation();
  return domain::Obstacle(problem, X_WorldTool, open, surroundings.parts).IsNone() &&
         domain::CanApproach(workcell, X_WorldTool, lowered) &&
         domain::CanApproach(workcell, X_WorldTool,
                             X_WorldTool.translation() - retreated.translation());
}

}  // namespace

Pose StraightBelow(const domain::Part& part, Pose X_WorldPart) {
  double lowest = (X_WorldPart * part.model->corners().front()).z();
  for (const Vector3& vertex : part.model->corners()) {
    lowest = std::min(lowest, (X_WorldPart * vertex).z());
  }
  X_WorldPart.translation().z() -= lowest;
  return X_WorldPart;
}

std::vector<Pose> FreePosesOn(const domain::Table& table, const domain::Problem& problem,
                              const Surroundings& surroundings, const Pose& X_WorldBelow) {
  const domain::Part& part = problem.part(surroundings.held->part);
  std::vector<Pose> free;
  for (const Vector2& spot : SpotsOf(table)) {
    for (const Pose& X_WorldPart : TurnedAt(spot, X_WorldBelow)) {
      if (!domain::IsOver(table, part, X_WorldPart)) continue;
      if (HasRoom(problem, surroundings, X_WorldPart)) free.push_back(X_WorldPart);
    }
  }
  return free;
}

std::optional<Pose> FreePoseIn(const domain::Place& place, const domain::Problem& problem,
                               const Surroundings& surroundings, const Pose& X_WorldBelow) {
  for (const Vector2& spot : SpotsOf(place)) {
    for (const Pose& X_WorldPart : TurnedAt(spot, X_WorldBelow)) {
      if (CanRelease(problem, surroundings, X_WorldPart)) return X_WorldPart;
    }
  }
  return std::nullopt;
}

}  // namespace assay::motion
