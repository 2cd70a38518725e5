#pragma once

#include "planner/domain/problem/problem.h"
#include "sim/cli/plans/report.h"

namespace assay::cli {

// What a scenario comes to: its parts with their computed stable poses, where they start and with
// how many grasps they can be taken there, and the clearances that the engine really has. It holds
// unless a clearance differs from the nominal by more than check::kPlayTolerance.
Report ReportOn(const domain::Problem& problem);

}  // namespace assay::cli
