#include <fmt/format.h>

#include <algorithm>

#include "planner/domain/reach/reachability.h"
#include "sim/enact/skills/skill.h"
#include "sim/exec/commands/action_commands.h"

namespace assay::enact {
namespace {

using domain::Grasp;
using exec::Pose;

// Returns the vertical component of the tool's z axis. It is -1 for a grasp from straight above,
// where the part stays as upright as the tool.
double LeanOf(const Grasp& grasp, const Pose& X_WorldPart) {
  return (X_WorldPart * grasp.X_PartTool).linear()(2, 2);
}

std::vector<domain::GraspId> MostUprightFirst(const domain::Part& part, const Pose& X_WorldPart) {
  std::vector<domain::GraspId> grasps;
  for (std::size_t i = 0; i < part.grasps->size(); ++i) grasps.emplace_back(i);
  const auto lean = [&](domain::GraspId id) {
    constexpr double kAlike = 1e-6;  // so that rounding does not decide the order
    return std::round(LeanOf((*part.grasps)[id.index()], X_WorldPart) / kAlike);
  };
  std::ranges::stable_sort(grasps, {}, lean);
  return grasps;
}

class PickUp : public Skill {
 public:
  exec::HeldTouches HeldMayTouch() const override { return exec::HeldTouches::kTables; }
  exec::Progress Do(const Roles& roles, Situation& situation) const override {
    const std::optional<plan::Hold> hold = ChooseHold(roles.part, situation);
    if (!hold) {
      return exec::Failure{exec::ExecutionOutcome::kUnreachable,
                           fmt::format("no grasp of {} is reachable where it is believed to be",
                                       situation.problem().part(roles.part).name)};
    }
    exec::Execution& execution = situation.execution();
    const plan::Action pickup{.kind = &domain::kPickup,
                              .part = roles.part,
                              .hold = *hold,
                              .place = {"believed", execution.world().PartPose(roles.part)}};
    return RunAll(exec::CommandsFor(situation.problem(), execution.world(), pickup).InOrder(),
                  execution);
  }

 private:
  // Returns the grasp that comes most from above. It must be reachable and leave room for the open
  // fingers.
  static std::optional<plan::Hold> ChooseHold(PartId id, const Situation& situation) {
    const domain::Problem& problem = situation.problem();
    const domain::Part& part = problem.part(id);
    const Pose X_WorldPart = situation.execution().world().PartPose(id);
    const std::vector<domain::PlacedPart> others = situation.Standing(id);
    const double open = problem.workcell->gripper().max_opening();
    for (const domain::GraspId grasp : MostUprightFirst(part, X_WorldPart)) {
      const Grasp& g = (*part.grasps)[grasp.index()];
      if (!Obstacle(problem, X_WorldPart * g.X_PartTool, open, others).IsNone()) continue;
      if (!IsReachableAt(problem, id, grasp, X_WorldPart)) continue;
      return plan::Hold{.grasp = g.label, .X_PartTool = g.X_PartTool, .width = g.width};
    }
    return std::nullopt;
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
