#pragma once

#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/checker/checker.h"
#include "planner/plan/data/plan.h"

namespace assay::assembly {

// Returns the flaws in the paths of a plan: in their ends, their clearance and the claims about
// them. A plan that has paths, or claims anything about them, must have a path to each step and one
// home.
std::vector<plan::Flaw> FlawsOfTravels(const domain::Problem& problem, const plan::Plan& plan);

}  // namespace assay::assembly
