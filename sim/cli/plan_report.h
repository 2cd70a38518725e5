#pragma once

#include "planner/plan/checker.h"
#include "planner/plan/plan.h"
#include "sim/cli/planned_problem.h"
#include "sim/cli/report.h"

namespace assay::cli {

// What the independent checker says about a plan, and whether its certificates hold up. It holds if
// there are no flaws.
Report ReportOn(const PlannedProblem& planned);

nlohmann::ordered_json ToJson(const plan::Plan& plan, const plan::CheckReport& report);

}  // namespace assay::cli
