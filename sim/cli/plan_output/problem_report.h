#pragma once

#include "planner/domain/problem/problem.h"
#include "sim/cli/plan_output/report.h"

namespace assay::cli {

// Reports the content of a scenario: its parts with their computed stable poses, where they start,
// the number of grasps with which they can be taken there, and the clearances measured in the
// engine. The report holds unless a clearance differs from the nominal one by more than
// check::kPlayTolerance.
Report ReportOn(const domain::Problem& problem);

}  // namespace assay::cli
