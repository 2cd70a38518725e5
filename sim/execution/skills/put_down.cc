#include "planner/domain/resting/resting.h"
#include "planner/motion/handling/putting_down.h"
#include "sim/execution/commands/action_commands.h"
#include "sim/execution/skills/skill.h"

namespace assay::execution {
namespace {

class PutDown : public Skill {
 public:
  HeldTouches HeldMayTouch() const override { return HeldTouches::kTables; }
  Progress Do(const Roles& roles, Situation& situation) const override {
    Execution& execution = situation.execution();
    const WorldModel& world = execution.world();
    const domain::Problem& problem = situation.problem();
    const domain::Part& part = problem.part(roles.part);
    if (world.held() != roles.part) return Cannot(part.name + " is not in the hand");
    const Pose below =
        motion::StraightBelow(part, world.PartPose(roles.part, execution.BelievedTool()));
    const std::optional<Pose> to =
        roles.place == nullptr
            ? below
            : motion::FreePoseIn(*roles.place, problem, execution.BelievedSurroundings(), below);
    if (!to) return Cannot("no spot for " + part.name + " in " + roles.place->name);
    if (!domain::OnTable(problem, roles.part, *to)) {
      return Cannot(part.name + " is over no table");
    }
    const plan::Action putdown{.kind = &domain::kPutdown,
                               .part = roles.part,
                               .hold = world.hold(),
                               .place = {"chosen", *to}};
    return RunAll(CommandsFor(problem, world, putdown).InOrder(), execution);
  }

 private:
  static Failure Cannot(const std::string& reason) { return {TrialOutcome::kUnreachable, reason}; }
};

}  // namespace

const SkillWord kPutDown = {
    .name = "put-down",
    .summary =
        "puts the held part down and lets go, at the place among the arguments or, without one, "
        "straight below the hand",
    .read = [](const Value& map, const SkillContext&) -> std::unique_ptr<const Skill> {
      map.AllowOnly({"skill"});
      return std::make_unique<PutDown>();
    },
};

}  // namespace assay::execution
