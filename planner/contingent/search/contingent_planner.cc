#include "planner/contingent/search/contingent_planner.h"

#include <utility>

#include "planner/contingent/search/exhaustive_tree.h"
#include "planner/contingent/search/first_tree.h"
#include "planner/contingent/search/hopeless_world.h"

namespace assay::contingent {
namespace {

ContingentPlan Exhaustive(const GroundTask& task, KnowledgeSpace& space) {
  ContingentPlan plan;
  ExhaustiveTree found = FindExhaustiveTree(space);
  if (found.tree) {
    plan.outcome = Outcome::kFound;
    plan.tree = std::move(*found.tree);
    plan.guarantee = found.repeats ? Guarantee::kIfFair : Guarantee::kLeastDepth;
  } else {
    const bool is_proved =
        found.is_complete || (!found.doubt.empty() && HasHopelessWorld(task, space.budget()));
    plan.outcome = is_proved ? Outcome::kNone : Outcome::kBudget;
    if (!is_proved) plan.doubt = found.doubt;
  }
  return plan;
}

ContingentPlan First(const GroundTask& task, KnowledgeSpace& space) {
  FirstTree found = FindFirstTree(space);
  ContingentPlan plan;
  if (found.tree) {
    plan.outcome = Outcome::kFound;
    plan.tree = std::move(*found.tree);
    return plan;
  }
  return found.is_proof_of_none ? plan : Exhaustive(task, space);
}

}  // namespace

ContingentPlan MakePlan(const GroundTask& task, Wanted wanted, Budget& budget) {
  KnowledgeSpace space(task, budget);
  ContingentPlan plan = wanted == Wanted::kFirst ? First(task, space) : Exhaustive(task, space);
  plan.states = static_cast<std::int64_t>(space.size());
  if (plan.outcome == Outcome::kNone && !space.doubt().empty()) {
    plan.outcome = Outcome::kBudget;
    plan.doubt = space.doubt();
  }
  return plan;
}

}  // namespace assay::contingent
