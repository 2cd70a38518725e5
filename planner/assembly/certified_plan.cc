#include "planner/assembly/certified_plan.h"

#include <functional>
#include <utility>

#include "planner/assembly/resolvers.h"
#include "planner/assembly/travel/travel_plan.h"
#include "planner/assembly/travel/work_judge.h"

namespace assay::assembly {
namespace {

// Paths are searched for until they have cost this many postures for each partial plan of the
// budget.
constexpr std::int64_t kPosturesForPartialPlan = 200;

domain::Problem WithoutErrors(domain::Problem problem) {
  for (domain::Part& part : problem.parts) part.error = {};
  problem.gripper_error = {};
  return problem;
}

}  // namespace

plan::PlanResult MakeCertifiedPlan(const domain::Problem& problem,
                                   const constraint_posting::PlannerOptions& planner,
                                   constraint_posting::UncertaintyOptions uncertainty) {
  if (uncertainty.resolvers.empty()) {
    uncertainty.resolvers = Resolvers(problem.resolvers, uncertainty.propagation);
  }
  plan::PlanResult result = constraint_posting::MakeCertifiedPlan(problem, planner, uncertainty);
  if (result.outcome != Outcome::kFound) return result;
  TravelEffort effort = {.left = kPosturesForPartialPlan * planner.partial_plans};
  const std::optional<plan::Reason> obstruction =
      AddTravels(problem, effort, result.plan, uncertainty.propagation);
  if (!obstruction) return result;
  WorkJudge judge(problem);
  uncertainty.judge = std::ref(judge);
  // Looks and squeezes that are inserted later make errors smaller. So a travel that has no path
  // with the errors at the start may have one afterwards.
  const domain::Problem exact = WithoutErrors(problem);
  for (const domain::Problem* errors : {&problem, &exact}) {
    uncertainty.can_be_executed = [&](plan::Plan instance) {
      return !AddTravels(*errors, effort, instance, uncertainty.propagation);
    };
    result = constraint_posting::MakeCertifiedPlan(problem, planner, uncertainty);
    if (result.outcome == Outcome::kFound &&
        !AddTravels(problem, effort, result.plan, uncertainty.propagation)) {
      return result;
    }
  }
  result.outcome = Outcome::kBudget;
  result.plan = {};
  result.obstruction = obstruction;
  return result;
}

}  // namespace assay::assembly
