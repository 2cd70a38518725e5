#pragma once

#include "planner/constraint_posting/impossibility/relaxed_problem.h"

namespace assay::constraint_posting {

// Returns true if no action leads out of the attainable set and the set misses a goal. Then no plan
// exists. The check is naive. It goes through every robot, part, grasp and place, and tests each
// action with the tests for plan instances (step_geometry.h). Only parts that surely are where they
// were at the start can be in the way. The check uses only the meaning of the attainable set, and
// none of the code that found this set.
bool Confirms(const domain::Problem& problem, const Attainable& attainable);

}  // namespace assay::constraint_posting
