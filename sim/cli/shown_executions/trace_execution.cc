#include <algorithm>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "sim/check/certificate_claims/certificate_check.h"
#include "sim/check/trial_verdicts/verdict.h"
#include "sim/cli/shown_executions/plan_of_request.h"
#include "sim/cli/tasks/noise_floor_cache.h"
#include "sim/cli/tasks/recorded_execution.h"

namespace assay::cli {
namespace {

// A trace does not say which errors were drawn, so no second execution with half the timestep
// confirms its violations (check::Confirmed).
std::string SourceOf(const ShowRequest& request, const std::vector<check::Claim>& claims) {
  const bool is_violated = std::ranges::any_of(claims, &check::Claim::IsViolated);
  return "trace " + request.input.string() +
         (is_violated ? "; its violations are not confirmed with half the timestep" : "");
}

}  // namespace

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
  const std::string source = SourceOf(request, claims);
  return {.problem = problem,
          .plan = plan,
          .scene = planned.simulation.scene,
          .trace = std::move(trace),
          .outcome = std::string(execution::Name(verdict.outcome)),
          .reason = verdict.reason,
          .claims = std::move(claims),
          .source = source,
          .plan_file = planned.plan_file};
}

}  // namespace assay::cli
