#pragma once

#include <string>
#include <vector>

#include "planner/constraint_posting/impossibility/relaxed_problem.h"

namespace assay::constraint_posting {

// Returns, in the scenario's words, the limits of this planner that a plan for the problem may need
// to exceed: robots other than the one that acts, mated parts that must be moved or mated again,
// and parts that do not rest on a table by themselves. `relaxed` is the relaxation of the problem
// in which parts can be taken only by the grasps that the problem lists
// (RelaxedProblem::Grasps::kListed).
std::vector<std::string> LimitsOf(const domain::Problem& problem, const RelaxedProblem& relaxed);

}  // namespace assay::constraint_posting
