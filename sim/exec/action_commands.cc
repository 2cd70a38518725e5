#include "sim/exec/action_commands.h"

#include <algorithm>

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
  if (step.strategy) {
    return CommandsFor(problem, world, std::get<plan::Assemble>(step.action), *step.strategy);
  }
  return std::visit(
      [&](const auto& action) { return CommandsFor(problem, world, action, step.certificate); },
      step.action);
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
