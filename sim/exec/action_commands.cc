#include "sim/exec/action_commands.h"

#include <algorithm>

#include "planner/uncertainty/sensing.h"

namespace assay::exec {
namespace {

// Which coordinates the planner counts on being taken from the sensor: what is known before the
// look is in the step's certificate. Without one all that the sensor measures is taken.
Look::Takes TakesOf(const domain::Problem& problem, const plan::Sense& sense,
                    const plan::Certificate& certificate) {
  constexpr Interval kUnknown = {-1e9, 1e9};
  const domain::SensorModel& sensor =
      *problem.workcell->uncertainty_operations().FindSensor(sense.sensor);
  plan::ErrorSet known = {
      .part = sense.part, .x = kUnknown, .y = kUnknown, .z = kUnknown, .theta = kUnknown};
  for (const plan::ErrorSet& set : certificate.before) {
    if (set.part == sense.part) known = set;
  }
  return {.x = uncertainty::TakesOver(known.x, sensor.x),
          .y = uncertainty::TakesOver(known.y, sensor.y),
          .z = uncertainty::TakesOver(known.z, sensor.z),
          .yaw = uncertainty::TakesOver(known.theta, sensor.theta)};
}

}  // namespace

std::vector<Command> StepCommands::InOrder() const {
  std::vector<Command> commands;
  for (const auto* phase : {&approach, &advance, &act, &depart}) {
    commands.insert(commands.end(), phase->begin(), phase->end());
  }
  return commands;
}

StepCommands CommandsFor(const domain::Problem& problem, const WorldModel& world,
                         const plan::PlannedStep& step) {
  const auto commands = [&](const auto& action) { return CommandsFor(problem, world, action); };
  StepCommands of_step = std::visit(commands, step.action);
  if (const auto* sense = std::get_if<plan::Sense>(&step.action)) {
    std::get<Look>(of_step.act.front()).takes = TakesOf(problem, *sense, step.certificate);
  }
  return of_step;
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
