#pragma once

#include "planner/domain/workcell/workcell.h"
#include "sim/cli/plan_output/report.h"

namespace assay::cli {

// Reports the table, gripper, rules and placements of a workcell, and its means against
// uncertainty.
Report ReportOn(const domain::Workcell& workcell);

}  // namespace assay::cli
