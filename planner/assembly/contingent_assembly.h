#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/assembly/knowledge/plan_knowledge.h"
#include "planner/base/outcome.h"
#include "planner/constraint_posting/uncertainty_phase/uncertainty_phase.h"
#include "planner/contingent/plan_tree/plan_tree.h"

namespace assay::assembly {

// One plan tree for all worlds of a scenario.
struct ContingentAssembly {
  Outcome outcome = Outcome::kBudget;
  std::vector<PlanOfWorlds> plans;  // each world belongs to one of the plans
  PlanKnowledge knowledge;
  contingent::PlanTree tree;  // valid if the outcome is kFound
  // The reason for any other outcome. With kNone it is the result for the world that has no plan,
  // and names this world. With kBudget it contains the limits that were met. Only one plan for each
  // world is considered, so a failure proves nothing if no sensor says which plan to follow.
  plan::PlanResult unplanned = {};
  int errors = 0;  // the number of steps that could not be proved, in all plans
};

// Returns what distinguishes the world from the others, such as "peg standing, block on-back".
std::string NameOf(const domain::Problem& world);

// Makes a plan tree for several worlds: Spar's uncertainty phase with contingent planning as one of
// its resolvers. The function plans for every world by MakeCertifiedPlan. At the beginning of these
// plans, it puts a look (a sensing action) at each part whose pose matters. Then it plans which
// looks are needed and when (contingent::MakePlan). A plan that works unchanged in other worlds is
// used for them too, so that no action looks at a pose that does not matter. `worlds` must come
// from domain::ReadWorlds.
ContingentAssembly MakeContingentPlan(const std::vector<domain::Problem>& worlds,
                                      const constraint_posting::PlannerOptions& planner,
                                      const constraint_posting::UncertaintyOptions& uncertainty);

}  // namespace assay::assembly
