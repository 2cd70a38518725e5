#include <fmt/format.h>

#include "planner/motion/handling/grasp_choice.h"
#include "sim/enact/skills/skill.h"
#include "sim/exec/commands/action_commands.h"

namespace assay::enact {
namespace {

class PickUp : public Skill {
 public:
  exec::HeldTouches HeldMayTouch() const override { return exec::HeldTouches::kTables; }
  exec::Progress Do(const Roles& roles, Situation& situation) const override {
    exec::Execution& execution = situation.execution();
    const domain::Problem& problem = situation.problem();
    const exec::Pose& X_WorldPart = execution.world().PartPose(roles.part);
    std::vector<domain::PlacedPart> others = execution.BelievedSurroundings().parts;
    std::erase_if(others, [&](const auto& placed) { return placed.part == roles.part; });
    const std::optional<plan::Hold> hold =
        motion::MostUprightHold(problem, roles.part, X_WorldPart, others);
    if (!hold) {
      return exec::Failure{exec::ExecutionOutcome::kUnreachable,
                           fmt::format("no grasp of {} is reachable where it is believed to be",
                                       problem.part(roles.part).name)};
    }
    const plan::Pickup pickup{roles.part, *hold, {"believed", X_WorldPart}};
    return RunAll(exec::CommandsFor(problem, execution.world(), pickup).InOrder(), execution);
  }
};

}  // namespace

const SkillWord kPickUp = {
    .name = "pick-up",
    .summary = "takes the part, as far from above as the arm can, and lifts it straight up",
    .read = [](const Value& map, const SkillContext&) -> std::unique_ptr<const Skill> {
      map.AllowOnly({"skill"});
      return std::make_unique<PickUp>();
    },
};

}  // namespace assay::enact
