#include "sim/cli/work/trial.h"

#include "sim/cli/program/interruption.h"
#include "sim/exec/execution/executor.h"

namespace assay::cli {
Trial RunTrial(const Experiment& experiment, int number, Film* film) {
  mujoco::Data data = experiment.scene.Start();
  if (film != nullptr) film->TakeStart(data);
  exec::ExecutorOptions options;
  options.on_timestep = [](const mujoco::Data&) { Interruption::BreakOffIfRequested(); };
  options.observer = film;
  exec::Trace trace =
      exec::Execute(experiment.problem, experiment.plan, experiment.scene, data, options);
  check::Verdict verdict = check::Judge(experiment.problem, trace, {});
  return {number, std::move(trace), std::move(verdict)};
}

}  // namespace assay::cli
