#pragma once

#include "planner/posting/impossibility/relaxed_problem.h"

namespace assay::posting {

// Whether no action leads from what is attainable to anything else, and a goal is missing: then no
// plan exists. Naive: goes through every robot, part, grasp and place, and asks of each action in
// turn whether it works, as plan instances are made (step_geometry.h), among the parts that surely
// are where they were at the start. It uses nothing of what found the set but its meaning.
bool Confirms(const domain::Problem& problem, const Attainable& attainable);

}  // namespace assay::posting
