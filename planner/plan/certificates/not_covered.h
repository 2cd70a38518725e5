#pragma once

#include <string>
#include <vector>

#include "planner/plan/data/plan.h"

namespace assay::plan {

// Returns what may make the plan fail though every precondition is proved: the contacts and motions
// of its actions that no condition covers (planner/uncertainty/README.md). Each is named once, in
// the order in which they may first matter.
std::vector<std::string> NotCovered(const Plan& plan);

}  // namespace assay::plan
