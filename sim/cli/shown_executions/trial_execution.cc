#include "sim/cli/shown_executions/trial_execution.h"

#include <utility>

namespace assay::cli {

ShownExecution NoiselessExecution(const check::Experiment& experiment, check::Trial trial,
                                  const std::string& source, const std::string& plan_file) {
  return {.problem = experiment.problem,
          .plan = experiment.plan,
          .scene = experiment.scene,
          .trace = std::move(trial.trace),
          .outcome = std::string(execution::Name(trial.verdict.outcome)),
          .reason = trial.verdict.reason,
          .source = source,
          .plan_file = plan_file};
}

ShownExecution TrialExecution(const check::Experiment& experiment, check::Trial trial,
                              const std::string& source, const std::string& plan_file) {
  const noise::Noise noise = std::move(trial.noise);
  std::vector<check::Claim> claims = std::move(trial.claims);
  ShownExecution shown = NoiselessExecution(experiment, std::move(trial), source, plan_file);
  shown.scene = execution::TrueScene(experiment.scene, noise);
  shown.believed = experiment.scene;
  shown.claims = std::move(claims);
  return shown;
}

}  // namespace assay::cli
