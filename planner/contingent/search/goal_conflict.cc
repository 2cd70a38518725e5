#include "planner/contingent/search/goal_conflict.h"

#include <utility>

#include "planner/contingent/grounding/ground_query.h"
#include "planner/contingent/search/contingent_planner.h"

namespace assay::contingent {
namespace {

std::vector<GroundQuery> PartsOf(const GroundQuery& goal) {
  if (goal.kind != GroundQuery::Kind::kAnd) return {goal};
  return goal.operands;
}

}  // namespace

GoalConflict FindGoalConflict(const GroundTask& task, Budget& budget) {
  GoalConflict conflict = {.parts = PartsOf(task.goal), .is_minimal = true};
  GroundTask reduced = task;
  for (std::size_t i = 0; i < conflict.parts.size() && conflict.parts.size() > 1;) {
    std::vector<GroundQuery> rest = conflict.parts;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
    reduced.goal = Joined(GroundQuery::Kind::kAnd, rest);
    const Outcome outcome = MakePlan(reduced, Wanted::kFirst, budget).outcome;
    if (outcome == Outcome::kNone) {
      conflict.parts = std::move(rest);
    } else {
      conflict.is_minimal &= outcome == Outcome::kFound;
      ++i;
    }
  }
  return conflict;
}

}  // namespace assay::contingent
