#include "sim/execution/commands/command_file.h"

#include <fmt/format.h>

namespace assay::execution {
namespace {

struct ActionText {
  const domain::Problem& problem;

  std::string operator()(const plan::Pickup& pickup) const {
    return fmt::format("pickup({}, {})", Name(pickup.part), pickup.hold.grasp);
  }
  std::string operator()(const plan::Putdown& putdown) const {
    return fmt::format("putdown({}, {})", Name(putdown.part), putdown.to.position);
  }
  std::string operator()(const plan::Assemble& assemble) const {
    const domain::Mating& mating = problem.mating(assemble.mating);
    return fmt::format("assemble({}, {})", Name(mating.held), Name(mating.fixed));
  }
  std::string operator()(const plan::Sense& sense) const {
    return fmt::format("sense({}, {})", Name(sense.part), sense.sensor);
  }
  std::string operator()(const plan::Squeeze& squeeze) const {
    return fmt::format("squeeze({}, {})", Name(squeeze.part), squeeze.hold.grasp);
  }
  const std::string& Name(PartId part) const { return problem.part(part).name; }
};

}  // namespace

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
    text +=
        fmt::format("{} {}: {}\n", planned.executed, planned.name, Text(problem, planned.action));
    for (const Command& command : step.InOrder()) text += "    " + Text(problem, command) + "\n";
  }
  return text + "home\n    " + Text(problem, file.home) + "\n";
}

std::string Text(const domain::Problem& problem, const plan::Action& action) {
  return std::visit(ActionText{problem}, action);
}

}  // namespace assay::execution
