#include "planner/contingent/search/contingent_planner.h"

#include <utility>

#include "planner/contingent/search/exhaustive_tree.h"
#include "planner/contingent/search/first_tree.h"

namespace assay::contingent {
namespace {

ContingentPlan Exhaustive(KnowledgeSpace& space) {
  ContingentPlan plan;
  ExhaustiveTree found = FindExhaustiveTree(space);
  if (found.tree) {
    plan.outcome = Outcome::kFound;
    plan.tree = std::move(*found.tree);
    plan.guarantee = found.repeats ? Guarantee::kIfFair : Guarantee::kLeastDepth;
  } else {
    plan.outcome = found.is_complete ? Outcome::kNone : Outcome::kBudget;
    plan.doubt = found.doubt;
  }
  return plan;
}

ContingentPlan First(KnowledgeSpace& space) {
  FirstTree found = FindFirstTree(space);
  ContingentPlan plan;
  if (found.tree) {
    plan.outcome = Outcome::kFound;
    plan.tree = std::move(*found.tree);
    return plan;
  }
  return found.is_proof_of_none ? plan : Exhaustive(space);
}

}  // namespace

ContingentPlan MakePlan(const GroundTask& task, Wanted wanted, Budget& budget) {
  KnowledgeSpace space(task, budget);
  ContingentPlan plan = wanted == Wanted::kFirst ? First(space) : Exhaustive(space);
  plan.states = static_cast<std::int64_t>(space.size());
  if (plan.outcome == Outcome::kNone && !space.doubt().empty()) {
    plan.outcome = Outcome::kBudget;
    plan.doubt = space.doubt();
  }
  return plan;
}

}  // namespace assay::contingent
