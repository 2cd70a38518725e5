#include "sim/cli/tasks/mating_task.h"

#include <fmt/format.h>

#include <utility>

#include "planner/base/check.h"
#include "planner/constraint_posting/resolvers/plan_states.h"
#include "sim/cli/command_line/usage_error.h"

namespace assay::cli {

MatingTask LastMatingOf(PlannedProblem planned) {
  std::vector<plan::Action> actions;
  for (const plan::StepId id : planned.result.plan.ExecutionOrder())
    actions.push_back(planned.result.plan.step(id).action);
  int step = static_cast<int>(actions.size()) - 1;
  while (step >= 0 && actions[step].mating.IsNone()) --step;
  if (step < 0)
    throw UsageError(fmt::format("mate: {}: no plan with an assemble action", planned.scenario));
  const auto states = plan::StatesOf(planned.problem, actions);
  const domain::PartId held = HandledPart(planned.problem, actions[step]);
  const auto latest = constraint_posting::LatestGraspable(planned.problem, states, step, held);
  ASSAY_CHECK(latest.has_value(), "a part that is mated was taken before");
  planned.problem =
      constraint_posting::ProblemFrom(planned.problem, states[static_cast<std::size_t>(*latest)]);
  return {std::move(planned), actions[step]};
}

}  // namespace assay::cli
