#include <fmt/format.h>

#include "planner/motion/handling/grasp_choice.h"
#include "sim/execution/commands/action_commands.h"
#include "sim/execution/skills/skill.h"

namespace assay::execution {
namespace {

class PickUp : public Skill {
 public:
  HeldTouches HeldMayTouch() const override { return HeldTouches::kTables; }
  Progress Do(const Roles& roles, Situation& situation) const override {
    Execution& execution = situation.execution();
    const domain::Problem& problem = situation.problem();
    const Pose& X_WorldPart = execution.world().PartPose(roles.part);
    std::vector<domain::PlacedPart> others = execution.BelievedSurroundings().parts;
    std::erase_if(others, [&](const auto& placed) { return placed.part == roles.part; });
    const std::optional<plan::Hold> hold =
        motion::MostUprightHold(problem, roles.part, X_WorldPart, others);
    if (!hold) {
      return Failure{TrialOutcome::kUnreachable,
                     fmt::format("no grasp of {} is reachable where it is believed to be",
                                 problem.part(roles.part).name)};
    }
    const plan::Action pickup{.kind = &domain::kPickup,
                              .part = roles.part,
                              .hold = *hold,
                              .place = {"believed", X_WorldPart}};
    return RunAll(CommandsFor(problem, execution.world(), pickup).InOrder(), execution);
  }
};

}  // namespace

const SkillWord kPickUp = {
    .name = "pick-up",
    .summary = "takes the part, from above if the arm can, and lifts it straight up",
    .read = [](const Value& map, const SkillContext&) -> std::unique_ptr<const Skill> {
      map.AllowOnly({"skill"});
      return std::make_unique<PickUp>();
    },
};

}  // namespace assay::execution
