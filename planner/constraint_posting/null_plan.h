#pragma once

#include "planner/domain/actions/action_template.h"
#include "planner/domain/problem/problem.h"

namespace assay::constraint_posting {

// Returns the first step of every plan. It adds all conditions that hold at the start.
domain::ActionTemplate InitialWorld(const domain::Problem& problem,
                                    domain::PlanVariables& variables);
// Returns the last step of every plan. Its preconditions are the goals.
domain::ActionTemplate Goals(const domain::Problem& problem, domain::PlanVariables& variables);

}  // namespace assay::constraint_posting
