#include <fmt/format.h>

#include "planner/domain/resting.h"
#include "sim/enact/skill.h"
#include "sim/exec/action_commands.h"

namespace assay::enact {
namespace {

using exec::Pose;

class PutDown : public Skill {
 public:
  exec::Progress Do(const Roles& roles, Situation& situation) const override {
    exec::Execution& execution = situation.execution;
    const exec::WorldModel& world = execution.world();
    const domain::Part& part = situation.problem().part(roles.part);
    if (world.held() != roles.part) return Cannot(part.name + " is not in the hand");
    const Pose below = StraightBelow(part, world.PartPose(roles.part, execution.BelievedTool()));
    if (!domain::OnTable(situation.problem(), roles.part, below)) {
      return Cannot(part.name + " is over no table");
    }
    const plan::Putdown putdown{roles.part, world.hold(), {"below", below}};
    return RunAll(exec::CommandsFor(situation.problem(), world, putdown).InOrder(), execution);
  }

 private:
  static exec::Failure Cannot(const std::string& reason) {
    return {exec::ExecutionOutcome::kUnreachable, reason};
  }

  // As it is held, with its lowest point on the table.
  static Pose StraightBelow(const domain::Part& part, Pose X_WorldPart) {
    double lowest = (X_WorldPart * part.model->hull().vertices.front()).z();
    for (const auto& vertex : part.model->hull().vertices) {
      lowest = std::min(lowest, (X_WorldPart * vertex).z());
    }
    X_WorldPart.translation().z() -= lowest;
    return X_WorldPart;
  }
};

}  // namespace

const SkillWord kPutDown = {
    .name = "put-down",
    .summary = "puts the held part down straight below the hand, and lets go",
    .read = [](const Value& map, const SkillContext&) -> std::unique_ptr<const Skill> {
      map.AllowOnly({"skill"});
      return std::make_unique<PutDown>();
    },
};

}  // namespace assay::enact
