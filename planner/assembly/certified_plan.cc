#include "planner/assembly/certified_plan.h"

#include <utility>

#include "planner/assembly/resolvers.h"
#include "planner/assembly/travel/travel_plan.h"

namespace assay::assembly {

plan::PlanResult MakeCertifiedPlan(const domain::Problem& problem,
                                   const constraint_posting::PlannerOptions& planner,
                                   constraint_posting::UncertaintyOptions uncertainty) {
  if (uncertainty.resolvers.empty()) {
    uncertainty.resolvers = Resolvers(problem.resolvers, uncertainty.propagation);
  }
  plan::PlanResult result = constraint_posting::MakeCertifiedPlan(problem, planner, uncertainty);
  if (result.outcome != Outcome::kFound) return result;
  const std::optional<plan::Reason> obstruction =
      AddTravels(problem, {}, result.plan, uncertainty.propagation);
  if (!obstruction) return result;
  // If a travel has no path before looks and squeezes are inserted, it has none afterwards either.
  uncertainty.can_be_executed = [&, propagation = uncertainty.propagation](plan::Plan instance) {
    return !AddTravels(problem, {}, instance, propagation);
  };
  result = constraint_posting::MakeCertifiedPlan(problem, planner, uncertainty);
  if (result.outcome == Outcome::kFound &&
      !AddTravels(problem, {}, result.plan, uncertainty.propagation))
    return result;
  result.outcome = Outcome::kBudget;
  result.plan = {};
  result.obstruction = obstruction;
  return result;
}

}  // namespace assay::assembly
