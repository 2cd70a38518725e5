#pragma once

#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"

namespace assay::plan {

// Returns the labels of the action that do not fit, in words. Labels of grasps and positions are
// for people, and must not mislead them: a label that the part has must be that of the pose beside
// it. Labels that the part does not have are the plan's own, and are not checked.
std::vector<std::string> MisleadingLabels(const domain::Problem& problem, const Action& action);

}  // namespace assay::plan
