#pragma once

#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"

namespace assay::plan {

// Returns what may make the plan fail though every precondition is proved: errors with which parts
// overlap at the start (domain::PairsThatMayOverlap), and the contacts and motions of its actions
// that no condition covers (planner/uncertainty/README.md). Each is named once, in the order in
// which they may first matter.
std::vector<std::string> NotCovered(const domain::Problem& problem, const Plan& plan);

}  // namespace assay::plan
