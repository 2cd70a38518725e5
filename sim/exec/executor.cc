#include "sim/exec/executor.h"

#include <algorithm>

#include "sim/exec/command_file.h"
#include "sim/exec/execution.h"

namespace assay::exec {
namespace {

constexpr double kRestDuration = 0.5;  // seconds
constexpr double kCalmDown = 0.1;      // seconds before, for the change to small timesteps

Progress RunAll(std::span<const Command> commands, Execution& execution) {
  for (std::size_t i = 0; i < commands.size(); ++i) {
    const auto run = [&](const auto& command) {
      return Run(command, commands.subspan(i + 1), execution);
    };
    if (Progress failure = std::visit(run, commands[i])) return failure;
  }
  return std::nullopt;
}

Progress RunStep(const plan::Plan& plan, const StepCommands& step, const ExecutorOptions& options,
                 Execution& execution) {
  const plan::PlannedStep& planned = plan.step(step.step);
  Progress failure = RunAll(step.commands, execution);
  if (failure) {
    failure->reason = planned.name + ": " + failure->reason;
    return failure;
  }
  const StepEnd end{step.step, planned.name, Text(execution.problem(), planned.action),
                    execution.Now()};
  execution.trace().events.push_back(end);
  if (options.on_step_end) options.on_step_end(end, execution.data());
  return std::nullopt;
}

Progress Rest(Execution& execution) {
  const scene::Scene& scene = execution.scene();
  mujoco::Data& data = execution.data();
  if (Progress failure = execution.Stay(kCalmDown, Stepping::kContact)) return failure;
  RestRecord rest{.duration = kRestDuration};
  rest.parts.resize(static_cast<std::size_t>(scene.part_count()));
  const double end = data.time() + kRestDuration;
  while (data.time() < end) {
    if (Progress failure = execution.Stay(0, Stepping::kContact)) return failure;
    for (std::size_t i = 0; i < rest.parts.size(); ++i) {
      const scene::Twist twist = scene.TrueTwist(data, PartId(i));
      rest.parts[i].linear = std::max(rest.parts[i].linear, twist.linear.norm());
      rest.parts[i].angular = std::max(rest.parts[i].angular, twist.angular.norm());
    }
  }
  execution.trace().events.push_back(rest);
  return std::nullopt;
}

Progress RunFile(const plan::Plan& plan, const CommandFile& file, const ExecutorOptions& options,
                 Execution& execution) {
  for (const StepCommands& step : file.steps) {
    if (Progress failure = RunStep(plan, step, options, execution)) return failure;
  }
  if (Progress failure = Run(file.home, {}, execution)) return failure;
  return Rest(execution);
}

}  // namespace

Trace Execute(const domain::Problem& problem, const plan::Plan& plan, const scene::Scene& scene,
              mujoco::Data& data, const ExecutorOptions& options) {
  Execution execution(problem, scene, data, options);
  const Progress failure = RunFile(plan, CommandFileOf(problem, plan), options, execution);
  ExecutionEnd end{.moment = execution.Now()};
  if (failure) {
    end.outcome = failure->outcome;
    end.reason = failure->reason;
  }
  execution.trace().events.push_back(end);
  return std::move(execution.trace());
}

}  // namespace assay::exec
