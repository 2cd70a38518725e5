#pragma once

#include <string>
#include <vector>

#include "planner/posting/impossibility/relaxed_problem.h"

namespace assay::posting {

// What this planner does not do, and a plan for the problem may need, in the scenario's words:
// other robots than the one that acts, parts that are mated and yet to be moved or mated again,
// parts that do not rest on a table by themselves. `relaxed`: of the problem, with its own grasps.
std::vector<std::string> LimitsOf(const domain::Problem& problem, const RelaxedProblem& relaxed);

}  // namespace assay::posting
