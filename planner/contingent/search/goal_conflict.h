#pragma once

#include <vector>

#include "planner/base/budget.h"
#include "planner/contingent/grounding/ground_task.h"

namespace assay::contingent {

// Why a task has no plan: parts of its goal that no plan reaches together.
struct GoalConflict {
  std::vector<GroundQuery> parts = {};  // in the order of the goal; at least one
  // Without any one of them there is a plan, or nothing is left. False: the budget was spent, or
  // nothing was proved of some of them, before that was seen.
  bool is_minimal = false;
};

// Finds the conflict of a task of which MakePlan has proved that it has no plan. Parts are left out
// one after another as long as it is proved that there is still no plan without them: what a plan
// for the whole goal does is also a plan for each part of it.
GoalConflict FindGoalConflict(const GroundTask& task, Budget& budget);

}  // namespace assay::contingent
