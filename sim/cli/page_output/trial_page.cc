#include "sim/cli/page_output/trial_page.h"

#include "sim/cli/page_output/noiseless_trial.h"

namespace assay::cli {

ViewedPage TrialPage(const check::Experiment& experiment, const check::Trial& trial,
                     const std::string& source, const std::string& plan_file) {
  const auto& [problem, plan, options, gate] = experiment;
  const scene::Scene scene(problem, execution::TrueScene(options, trial.noise));
  const scene::Scene believed(problem, options);
  const check::Trial noiseless = NoiselessTrial(problem, plan, believed);
  return PageOf({.problem = problem,
                 .plan = plan,
                 .scene = scene,
                 .trace = trial.trace,
                 .outcome = std::string(execution::Name(trial.verdict.outcome)),
                 .reason = trial.verdict.reason,
                 .claims = trial.claims,
                 .beside = view::Beside{"the plan without noise", believed, noiseless.trace},
                 .source = source,
                 .plan_file = plan_file});
}

}  // namespace assay::cli
