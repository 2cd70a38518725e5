#include <tuple>
#include <utility>

#include "sim/check/certificate_claims/certificate_check.h"
#include "sim/check/trial_verdicts/verdict.h"
#include "sim/cli/shown_executions/plan_of_request.h"
#include "sim/cli/tasks/noise_floor_cache.h"
#include "sim/cli/tasks/recorded_execution.h"

namespace assay::cli {

ShownExecution TraceExecution(const ShowRequest& request, std::string_view text) {
  const PlannedProblem planned = PlanOf(request);
  execution::Trace trace = ReadTraceOf(planned, text, request.input);
  const auto& [problem, plan] = std::tie(planned.problem, planned.result.plan);
  const check::Verdict verdict = check::Judge(problem, trace, {});
  std::vector<check::Claim> claims;
  if (request.needs_claims) {
    claims = check::CheckCertificates(problem, plan, trace,
                                      KeptNoiseFloor(problem, plan, planned.simulation.scene));
  }
  return {.problem = problem,
          .plan = plan,
          .scene = planned.simulation.scene,
          .trace = std::move(trace),
          .outcome = std::string(execution::Name(verdict.outcome)),
          .reason = verdict.reason,
          .claims = std::move(claims),
          .source = "trace " + request.input.string(),
          .plan_file = planned.plan_file};
}

}  // namespace assay::cli
