#pragma once

#include <string>

#include "planner/constraint_posting/impossibility/relaxed_problem.h"

namespace assay::constraint_posting {

// Returns the constraint in the scenario's words.
std::string Describe(const RelaxedProblem& relaxed, const Constraint& constraint);

// Returns the name of the stable pose, or its label if it has no name.
std::string PoseName(const domain::Part& part, domain::StablePoseId pose);

}  // namespace assay::constraint_posting
