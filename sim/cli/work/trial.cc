#include "sim/cli/work/trial.h"

#include "sim/cli/program/interruption.h"
#include "sim/execution/walk/executor.h"

namespace assay::cli {
Trial RunTrial(const Experiment& experiment, int number, Film* film) {
  mujoco::Data data = experiment.scene.Start();
  if (film != nullptr) film->TakeStart(data);
  execution::ExecutorOptions options;
  options.on_timestep = [](const mujoco::Data&) { Interruption::BreakOffIfRequested(); };
  options.observer = film;
  execution::Trace trace =
      execution::Execute(experiment.problem, experiment.plan, experiment.scene, data, options);
  check::Verdict verdict = check::Judge(experiment.problem, trace, {});
  return {number, std::move(trace), std::move(verdict)};
}

}  // namespace assay::cli
