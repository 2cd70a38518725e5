#include "sim/cli/page_output/noiseless_trial.h"

#include "sim/cli/command_line/interruption.h"
#include "sim/cli/command_line/progress.h"

namespace assay::cli {

check::Trial NoiselessTrial(const domain::Problem& problem, const plan::Plan& plan,
                            const scene::Scene& scene) {
  const Progress progress("executing the plan for " + problem.name);
  execution::ExecutorOptions executor;
  executor.on_timestep = Interruption::BreakOffAfter;
  return check::RunTrial(problem, plan, scene, executor);
}

}  // namespace assay::cli
