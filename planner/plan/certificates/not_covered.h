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

// Returns the steps, in the order of execution, for which a condition on the arm's ways could not be
// proved. Returns none if the plan claims nothing about ways.
std::vector<int> StepsWithUnprovedWays(const Plan& plan);

}  // namespace assay::plan
