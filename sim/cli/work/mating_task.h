#pragma once

#include "planner/plan/data/plan.h"
#include "sim/cli/work/planned_problem.h"

namespace assay::cli {

// One mating of a plan, taken by itself.
struct MatingTask {
  PlannedProblem planned;   // its problem begins just before the hand takes the held part
  plan::Assemble assemble;  // of the plan
};

// The plan's last. Throws UsageError if there is none.
MatingTask LastMatingOf(PlannedProblem planned);

}  // namespace assay::cli
