#pragma once

#include "sim/cli/shown_executions/shown_execution.h"
#include "sim/cli/tasks/planned_problem.h"

namespace assay::cli {

// Returns what is shown of a problem for which no plan was found: the scene as it lies, and the
// reasons.
ShownExecution MissingPlan(const PlannedProblem& planned);

}  // namespace assay::cli
