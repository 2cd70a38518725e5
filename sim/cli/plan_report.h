#pragma once

#include "planner/domain/problem.h"
#include "planner/plan/checker.h"
#include "planner/plan/plan.h"
#include "sim/cli/report.h"

namespace assay::cli {

// What the independent checker says about a plan. It holds if there are no flaws.
Report ReportOn(const domain::Problem& problem, const plan::PlanResult& result);

nlohmann::ordered_json ToJson(const plan::Plan& plan, const plan::CheckReport& report);

}  // namespace assay::cli
