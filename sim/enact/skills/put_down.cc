#include <fmt/format.h>

#include <array>
#include <numbers>

#include "planner/domain/part/resting.h"
#include "planner/domain/reach/action_ways.h"
#include "planner/domain/reach/reachability.h"
#include "sim/enact/skills/skill.h"
#include "sim/exec/commands/action_commands.h"

namespace assay::enact {
namespace {

using exec::Pose;
using geometry::Vector2;

constexpr double kSpotPitch = 0.10;  // metres between spots
constexpr double kSpotRoom = 0.025;  // metres between parts, room for errors and opening fingers

// Returns the pose of the held part after a move straight down until its lowest point is on the
// table.
Pose StraightBelow(const domain::Part& part, Pose X_WorldPart) {
  double lowest = (X_WorldPart * part.model->hull().vertices.front()).z();
  for (const auto& vertex : part.model->hull().vertices) {
    lowest = std::min(lowest, (X_WorldPart * vertex).z());
  }
  X_WorldPart.translation().z() -= lowest;
  return X_WorldPart;
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

class PutDown : public Skill {
 public:
  exec::HeldTouches HeldMayTouch() const override { return exec::HeldTouches::kTables; }
  exec::Progress Do(const Roles& roles, Situation& situation) const override {
    exec::Execution& execution = situation.execution();
    const exec::WorldModel& world = execution.world();
    const domain::Part& part = situation.problem().part(roles.part);
    if (world.held() != roles.part) return Cannot(part.name + " is not in the hand");
    const Pose below = StraightBelow(part, world.PartPose(roles.part, execution.BelievedTool()));
    const std::optional<Pose> to =
        roles.place != nullptr ? FreeSpot(*roles.place, below, situation) : below;
    if (!to) return Cannot("no spot for " + part.name + " in " + roles.place->name);
    if (!domain::OnTable(situation.problem(), roles.part, *to)) {
      return Cannot(part.name + " is over no table");
    }
    const plan::Putdown putdown{roles.part, world.hold(), {"chosen", *to}};
    return RunAll(exec::CommandsFor(situation.problem(), world, putdown).InOrder(), execution);
  }

 private:
  static exec::Failure Cannot(const std::string& reason) {
    return {exec::ExecutionOutcome::kUnreachable, reason};
  }

  // Returns the first pose in the place where the arm can release the part, with room for the part
  // and for the open fingers. All turns about the vertical from `below` are tried at one spot
  // before the next spot.
  static std::optional<Pose> FreeSpot(const domain::Place& place, const Pose& below,
                                      Situation& situation) {
    for (const Vector2& spot : SpotsOf(place)) {
      for (int i = 0; i < kYawsTried; ++i) {
        Pose X_WorldPart = geometry::RotationZ(2 * std::numbers::pi * i / kYawsTried) * below;
        X_WorldPart.translation() << spot, below.translation().z();
        if (IsFree(X_WorldPart, situation)) return X_WorldPart;
      }
    }
    return std::nullopt;
  }

  static bool IsFree(const Pose& X_WorldPart, Situation& situation) {
    const domain::Problem& problem = situation.problem();
    const exec::WorldModel& world = situation.execution().world();
    const std::vector<domain::PlacedPart> others = situation.Standing(world.held());
    for (const domain::PlacedPart& other : others) {
      const double gap = Distance(problem.part(world.held()).model->shape(), X_WorldPart,
                                  problem.part(other.part).model->shape(), other.X_WorldPart);
      if (gap < kSpotRoom) return false;
    }
    const domain::Workcell& workcell = *problem.workcell;
    const Pose X_WorldTool = X_WorldPart * world.hold().X_PartTool;
    const Pose retreated = exec::Retreated(workcell, X_WorldTool);
    const double open = workcell.gripper().max_opening();
    const geometry::Vector3 lowered =
        X_WorldTool.translation() - exec::AtSafeHeight(workcell, X_WorldTool).translation();
    return domain::Obstacle(problem, X_WorldTool, open, others).IsNone() &&
           domain::CanApproach(workcell, X_WorldTool, lowered) &&
           domain::CanApproach(workcell, X_WorldTool,
                               X_WorldTool.translation() - retreated.translation());
  }
};

}  // namespace

const SkillWord kPutDown = {
    .name = "put-down",
    .summary =
        "puts the held part down, at the place of the arguments or else straight below the "
        "hand, and lets go",
    .read = [](const Value& map, const SkillContext&) -> std::unique_ptr<const Skill> {
      map.AllowOnly({"skill"});
      return std::make_unique<PutDown>();
    },
};

}  // namespace assay::enact
