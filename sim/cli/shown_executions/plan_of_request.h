#pragma once

#include "sim/cli/shown_executions/shown_execution.h"
#include "sim/cli/tasks/planned_problem.h"

namespace assay::cli {

// Reads the plan of a trace or a result, which does not hold its plan: the named plan, or plan.json
// beside the input. Throws UsageError if neither is there.
PlannedProblem PlanOf(const ShowRequest& request);

}  // namespace assay::cli
