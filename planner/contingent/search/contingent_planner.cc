#include "planner/contingent/search/contingent_planner.h"

#include <utility>

#include "planner/contingent/search/exhaustive_tree.h"
#include "planner/contingent/search/first_tree.h"
#include "planner/contingent/search/hopeless_world.h"

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
    const bool is_searched = found.is_complete || !found.doubt.empty();
    plan.outcome = is_searched ? Outcome::kNone : Outcome::kBudget;
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

// A world without a way to the goal proves that there is no plan, whatever the search left out.
void ProveOrDoubt(const GroundTask& task, KnowledgeSpace& space, ContingentPlan& plan) {
  if (plan.doubt.empty()) plan.doubt = space.doubt();
  if (plan.doubt.empty()) return;
  if (HasHopelessWorld(task, space.budget())) {
    plan.doubt.clear();
  } else {
    plan.outcome = Outcome::kBudget;
  }
}

}  // namespace

ContingentPlan MakePlan(const GroundTask& task, Wanted wanted, Budget& budget) {
  KnowledgeSpace space(task, budget);
  ContingentPlan plan = wanted == Wanted::kFirst ? First(space) : Exhaustive(space);
  plan.states = static_cast<std::int64_t>(space.size());
  if (plan.outcome == Outcome::kNone) ProveOrDoubt(task, space, plan);
  return plan;
}

}  // namespace assay::contingent
