#include "sim/check/certificate_claims/certificate_check.h"
#include "sim/check/trial_verdicts/verdict.h"
#include "sim/cli/page_output/plan_of_request.h"
#include "sim/cli/page_output/viewed_page.h"
#include "sim/cli/tasks/noise_floor_cache.h"
#include "sim/cli/tasks/recorded_execution.h"

namespace assay::cli {
ViewedPage TracePage(const ViewRequest& request, std::string_view text) {
  const PlannedProblem planned = PlanOf(request);
  const execution::Trace trace = ReadTraceOf(planned, text, request.input);
  const auto& [problem, plan] = std::tie(planned.problem, planned.result.plan);
  const scene::Scene scene(problem, planned.simulation.scene);
  const check::NoiseFloor gate =
      KeptNoiseFloor(problem, plan, planned.simulation.scene, "assay view");
  const check::Verdict verdict = check::Judge(problem, trace, {});
  return PageOf({.problem = problem,
                 .plan = plan,
                 .scene = scene,
                 .trace = trace,
                 .outcome = std::string(execution::Name(verdict.outcome)),
                 .reason = verdict.reason,
                 .claims = check::CheckCertificates(problem, plan, trace, gate),
                 .source = "trace " + request.input.string(),
                 .plan_file = planned.plan_file});
}

}  // namespace assay::cli
