#include "sim/check/trial_verdicts/verdict.h"

#include <fmt/format.h>

#include <algorithm>

#include "planner/base/check.h"
#include "sim/execution/trial/goal_findings.h"

namespace assay::check {
namespace {

using domain::Problem;
using execution::Aspect;
using execution::Finding;
using execution::GraspFact;

TrialOutcome TrialOutcomeOf(Aspect aspect) {
  switch (aspect) {
    case Aspect::kSeated:
      return TrialOutcome::kNotSeated;
    case Aspect::kAligned:
      return TrialOutcome::kMisaligned;
    case Aspect::kReleased:
      return TrialOutcome::kNotReleased;
    case Aspect::kAtRest:
      return TrialOutcome::kNotAtRest;
    case Aspect::kLocated:
      return TrialOutcome::kNotLocated;
  }
  ASSAY_CHECK(false, "an aspect that the switch does not know");
  return {};
}

std::string Reason(const execution::CollisionRecord& collision) {
  return fmt::format("at {:.2f} s {} touched {}", collision.time, collision.robot, collision.other);
}

std::string Reason(const Problem& problem, const GraspFact& fact) {
  return fmt::format("at {:.2f} s the gripper closed on {} to {:.2f} mm instead of {:.2f} mm{}",
                     fact.time, problem.part(fact.part).name, 1e3 * fact.opening,
                     1e3 * fact.expected_width,
                     fact.pads_touch ? "" : ", and not both pads touched it");
}

}  // namespace

Verdict Judge(const Problem& problem, const execution::Trace& trace,
              const execution::Limits& limits) {
  Verdict verdict{.findings = execution::GoalFindings(problem, trace, limits)};
  const execution::ExecutionEnd& end = trace.end();
  if (end.outcome != TrialOutcome::kSucceeded) {
    verdict.outcome = end.outcome;
    verdict.reason = end.reason;
    return verdict;
  }
  if (const auto collisions = trace.All<execution::CollisionRecord>(); !collisions.empty()) {
    verdict.outcome = TrialOutcome::kCollided;
    verdict.reason = Reason(*collisions.front());
    return verdict;
  }
  const Finding* worst = nullptr;
  for (const Finding& finding : verdict.findings) {
    if (finding.holds) continue;
    if (worst == nullptr || TrialOutcomeOf(finding.aspect) < TrialOutcomeOf(worst->aspect))
      worst = &finding;
  }
  if (worst == nullptr) return verdict;
  verdict.outcome = TrialOutcomeOf(worst->aspect);
  verdict.reason = Text(*worst);
  for (const GraspFact* fact : trace.All<GraspFact>()) {
    if (fact->holds()) continue;
    return {TrialOutcome::kGraspFailed, Reason(problem, *fact) + "; " + verdict.reason,
            std::move(verdict.findings)};
  }
  return verdict;
}

}  // namespace assay::check
