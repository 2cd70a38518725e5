#include "sim/cli/shown_executions/missing_plan.h"

#include "sim/execution/robots/execution.h"

namespace assay::cli {
namespace {

// Returns a trace of the start alone.
execution::Trace StillOf(const domain::Problem& problem, const scene::Scene& scene) {
  mujoco::Data data = scene.Start();
  const execution::ExecutorOptions options;
  const execution::Snapshot start = execution::Execution(problem, scene, data, options).Now();
  return {.problem = problem.name,
          .parts = {},
          .events = {execution::Sample{start}, execution::ExecutionEnd{.snapshot = start}}};
}

std::vector<plan::Reason> WithoutSituations(const std::vector<std::string>& sentences) {
  std::vector<plan::Reason> reasons;
  for (const std::string& sentence : sentences) reasons.push_back({.text = sentence});
  return reasons;
}

// An empty situation has no bodies to be shown, even if the sentence names some.
std::vector<plan::Reason> AboutNoBodies(const std::vector<std::string>& sentences) {
  std::vector<plan::Reason> reasons = WithoutSituations(sentences);
  for (plan::Reason& reason : reasons) reason.situation.emplace();
  return reasons;
}

// The sentences are those of `assay plan`.
std::vector<view::Reasons> ReasonsOf(const plan::PlanResult& result) {
  std::vector<view::Reasons> reasons;
  const auto add = [&](const char* title, const std::vector<plan::Reason>& of_kind) {
    if (!of_kind.empty()) reasons.push_back({title, of_kind});
  };
  add("These conditions cannot hold together", result.conflict);
  add("The nearest misses", result.near_misses);
  if (result.obstruction) add("The arm can execute no plan that was found", {*result.obstruction});
  add("Limits of the planner", WithoutSituations(result.limits));
  add("The proof holds under these hypotheses", AboutNoBodies(result.hypotheses));
  if (reasons.empty()) {
    add("The budget was spent before there was an answer",
        {{.text = "--budget sets a greater budget"}});
  }
  return reasons;
}

}  // namespace

ShownExecution MissingPlan(const PlannedProblem& planned) {
  const plan::PlanResult& result = planned.result;
  const scene::Scene scene(planned.problem, planned.simulation.scene);
  return {.problem = planned.problem,
          .plan = result.plan,
          .scene = planned.simulation.scene,
          .trace = StillOf(planned.problem, scene),
          .outcome = result.outcome == Outcome::kNone ? "No plan exists" : "No plan was found",
          .why_not = ReasonsOf(result),
          .source = "scenario " + planned.file(),
          .plan_file = planned.file(),
          .code = ExitCodeOf(result.outcome)};
}

}  // namespace assay::cli
