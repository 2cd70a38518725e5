#pragma once

#include "sim/cli/page_output/viewed_page.h"
#include "sim/cli/tasks/planned_problem.h"

namespace assay::cli {

// Makes the page of a problem for which no plan was found: the scene as it lies, and the reasons.
ViewedPage NoPlanPage(const PlannedProblem& planned);

}  // namespace assay::cli
