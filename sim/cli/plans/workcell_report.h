#pragma once

#include "planner/domain/workcell/workcell.h"
#include "sim/cli/plans/report.h"

namespace assay::cli {

// The table, gripper, rules and placements of a workcell, and what it can do about uncertainty.
Report ReportOn(const domain::Workcell& workcell);

}  // namespace assay::cli
