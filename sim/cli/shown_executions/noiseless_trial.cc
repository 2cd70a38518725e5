#include "sim/cli/shown_executions/noiseless_trial.h"

#include "sim/cli/command_line/progress.h"

namespace assay::cli {

check::Trial NoiselessTrial(const check::Experiment& experiment) {
  const Progress progress("executing the plan for " + experiment.problem.name);
  const scene::Scene scene(experiment.problem, experiment.scene);
  return check::RunTrial(experiment.problem, experiment.plan, scene, {});
}

}  // namespace assay::cli
