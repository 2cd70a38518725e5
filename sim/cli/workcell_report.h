#pragma once

#include "planner/domain/workcell.h"
#include "sim/cli/report.h"

namespace assay::cli {

// The table, gripper, rules and placements of a workcell, and what it can do about uncertainty.
Report ReportOn(const domain::Workcell& workcell);

}  // namespace assay::cli
