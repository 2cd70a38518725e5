#pragma once

#include <vector>

#include "planner/base/budget.h"
#include "planner/contingent/grounding/ground_task.h"

namespace assay::contingent {

// The reason why a task has no plan: parts of its goal that no plan can achieve together.
struct GoalConflict {
  std::vector<GroundQuery> parts = {};  // at least one part, in the order of the goal
  // True if a plan exists as soon as any one of the parts is left out, or if there is only one
  // part. False if the budget was spent before, or if nothing was proved about some of the parts.
  bool is_minimal = false;
};

// Finds the conflict of a task for which MakePlan has proved that there is no plan. The function
// leaves out one part of the goal after another, as long as there is provably no plan for the
// remaining goal. This is valid because a plan for the whole goal is also a plan for each part.
GoalConflict FindGoalConflict(const GroundTask& task, Budget& budget);

}  // namespace assay::contingent
