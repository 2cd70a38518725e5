#pragma once

#include "planner/plan/data/plan.h"
#include "sim/cli/tasks/planned_problem.h"

namespace assay::cli {

// One mating of a plan, by itself.
struct MatingTask {
  PlannedProblem planned;  // its problem begins just before the hand takes the held part
  plan::Action assemble;   // an action of the plan
};

// Returns the plan's last mating. Throws UsageError if there is none.
MatingTask LastMatingOf(PlannedProblem planned);

}  // namespace assay::cli
