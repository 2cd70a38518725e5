#include <fmt/format.h>

#include <utility>

#include "sim/cli/shown_executions/missing_plan.h"
#include "sim/cli/shown_executions/noiseless_trial.h"
#include "sim/cli/shown_executions/trial_execution.h"
#include "sim/cli/tasks/planned_problem.h"

namespace assay::cli {

ShownExecution PlanExecution(const ShowRequest& request, const Document& document) {
  const bool is_plan = IsPlanFile(document);
  const PlannedProblem planned = ReadOrMakePlan(document, request.models);
  RequireSound(planned);
  if (planned.result.outcome != Outcome::kFound) return MissingPlan(planned);
  const check::Experiment experiment{planned.problem, planned.result.plan,
                                     planned.simulation.scene};
  check::Trial trial = NoiselessTrial(experiment);
  const bool has_failed = trial.verdict.outcome != execution::TrialOutcome::kSucceeded;
  ShownExecution shown =
      NoiselessExecution(experiment, std::move(trial),
                         fmt::format("{} {}, executed without noise", is_plan ? "plan" : "scenario",
                                     request.input.string()),
                         planned.file());
  if (has_failed) shown.code = ExitCode::kFailed;
  return shown;
}

}  // namespace assay::cli
