#include "sim/execution/commands/command_file.h"

#include <fmt/format.h>

namespace assay::execution {

CommandFile CommandFileOf(const domain::Problem& problem, const plan::Plan& plan) {
  CommandFile file;
  WorldModel world(problem);
  for (const plan::StepId id : plan.ExecutionOrder()) {
    file.steps.push_back(CommandsFor(problem, world, plan, id));
    file.steps.back().step = id;
    for (const Command& command : file.steps.back().InOrder()) world.Foresee(command);
  }
  file.home = HomingOf(problem, plan);
  return file;
}

std::string Text(const domain::Problem& problem, const plan::Plan& plan, const CommandFile& file) {
  std::string text;
  for (const StepCommands& step : file.steps) {
    const plan::PlannedStep& planned = plan.step(step.step);
    text += fmt::format("{} {}: {}\n", planned.executed, planned.name,
                        plan::ShortText(problem, planned.action));
    for (const Command& command : step.InOrder()) text += "    " + Text(problem, command) + "\n";
  }
  return text + "home\n    " + Text(problem, file.home) + "\n";
}

}  // namespace assay::execution
