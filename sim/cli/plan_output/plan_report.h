#pragma once

#include "planner/plan/checker/checker.h"
#include "planner/plan/data/plan.h"
#include "sim/cli/plan_output/report.h"
#include "sim/cli/tasks/planned_problem.h"

namespace assay::cli {

// Reports what the independent checker finds in a plan, and whether its certificates hold up. The
// report holds if there are no flaws.
Report ReportOn(const PlannedProblem& planned);

nlohmann::ordered_json ToJson(const plan::Plan& plan, const plan::CheckReport& report);

}  // namespace assay::cli
