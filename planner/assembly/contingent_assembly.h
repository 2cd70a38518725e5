#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/assembly/plan_knowledge.h"
#include "planner/base/outcome.h"
#include "planner/contingent/tree/plan_tree.h"
#include "planner/posting/uncertainty_phase/uncertainty_phase.h"

namespace assay::assembly {

// One plan tree for all worlds of a scenario.
struct ContingentAssembly {
  Outcome outcome = Outcome::kBudget;
  std::vector<PlanOfWorlds> plans;  // each world is in one of them
  PlanKnowledge knowledge;
  contingent::PlanTree tree;  // at kFound
  // At other outcomes: why there is none. At kNone of the world that has no plan, which is told; at
  // kBudget the limits that were met: one plan for each world is looked at, so that it is no proof
  // if no sensor tells when to follow which.
  plan::PlanResult unplanned = {};
  int errors = 0;  // steps that could not be proved, in all plans
};

// "peg standing, block on-back": what tells the world from the others.
std::string NameOf(const domain::Problem& world);

// Plans for every world by MakeCertifiedPlan, begins these plans with a look at each part whose
// pose matters, and plans what to find out when (contingent::MakePlan): Spar's uncertainty phase
// with contingent planning as one of its resolvers. A plan that works as it is in other worlds,
// too, is theirs as well, so that nobody looks at what does not matter. `worlds`: of
// domain::ReadWorlds.
ContingentAssembly MakeContingentPlan(const std::vector<domain::Problem>& worlds,
                                      const posting::PlannerOptions& planner,
                                      const posting::UncertaintyOptions& uncertainty);

}  // namespace assay::assembly
