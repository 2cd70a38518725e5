#include "sim/exec/action_commands.h"

#include <algorithm>
#include <optional>

namespace assay::exec {
std::vector<Command> StepCommands::InOrder() const {
  std::vector<Command> commands;
  for (const auto* phase : {&approach, &advance, &act, &depart}) {
    commands.insert(commands.end(), phase->begin(), phase->end());
  }
  return commands;
}

StepCommands CommandsFor(const domain::Problem& problem, const WorldModel& world,
                         const plan::PlannedStep& step) {
  return std::visit(
      [&](const auto& action) { return CommandsFor(problem, world, action, step.certificate); },
      step.action);
}

// Both preconditions are that what is uncertain stays within the guarded travel.
double DoubtOfContact(const domain::WorkcellRules& rules, const plan::Certificate& certificate) {
  std::optional<double> margin;
  for (const plan::CertifiedPrecondition& claim : certificate.preconditions) {
    if (claim.condition != "landing height" && claim.condition != "seat") continue;
    margin = std::min(margin.value_or(claim.margin), claim.margin);
  }
  return rules.guarded_travel - std::max(0.0, margin.value_or(0));
}

Pose HomeTool(const domain::Workcell& workcell) {
  return workcell.X_WorldBase() * workcell.arm().Forward(workcell.home()) *
         workcell.gripper().X_FlangeTool();
}

Pose Retreated(const domain::Workcell& workcell, const Pose& X_WorldTool) {
  return X_WorldTool * geometry::Translation(0, 0, -workcell.rules().approach_distance);
}

Pose AtSafeHeight(const domain::Workcell& workcell, const Pose& X_WorldTool) {
  Pose raised = X_WorldTool;
  raised.translation().z() = std::max(raised.translation().z(), workcell.rules().safe_height);
  return raised;
}

}  // namespace assay::exec
