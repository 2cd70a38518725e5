#include <fmt/format.h>

#include "sim/cli/page_output/no_plan_page.h"
#include "sim/cli/page_output/noiseless_trial.h"
#include "sim/cli/page_output/viewed_page.h"
#include "sim/cli/tasks/planned_problem.h"

namespace assay::cli {

ViewedPage PlanPage(const ViewRequest& request, const Document& document) {
  const bool is_plan = IsPlanFile(document);
  const PlannedProblem planned = ReadOrMakePlan(document, request.models);
  if (planned.result.outcome != Outcome::kFound) return NoPlanPage(planned);
  const scene::Scene scene(planned.problem, planned.simulation.scene);
  const check::Trial trial = NoiselessTrial(planned.problem, planned.result.plan, scene);
  ViewedPage page =
      PageOf({.problem = planned.problem,
              .plan = planned.result.plan,
              .scene = scene,
              .trace = trial.trace,
              .outcome = std::string(execution::Name(trial.verdict.outcome)),
              .reason = trial.verdict.reason,
              .source = fmt::format("{} {}, executed without noise", is_plan ? "plan" : "scenario",
                                    request.input.string()),
              .plan_file = planned.file()});
  if (trial.verdict.outcome != execution::TrialOutcome::kSucceeded) page.code = ExitCode::kFailed;
  return page;
}

}  // namespace assay::cli
