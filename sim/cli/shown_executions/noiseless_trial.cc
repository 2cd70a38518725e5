#include "sim/cli/shown_executions/noiseless_trial.h"

#include "sim/cli/command_line/interruption.h"
#include "sim/cli/command_line/progress.h"

namespace assay::cli {

check::Trial NoiselessTrial(const check::Experiment& experiment) {
  const Progress progress("executing the plan for " + experiment.problem.name);
  const scene::Scene scene(experiment.problem, experiment.scene);
  execution::ExecutorOptions executor;
  executor.on_timestep = Interruption::BreakOffAfter;
  return check::RunTrial(experiment.problem, experiment.plan, scene, executor);
}

}  // namespace assay::cli
