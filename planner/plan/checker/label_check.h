#pragma once

#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"

namespace assay::plan {

// Returns, in words, the labels of the action that do not fit. The labels of grasps and positions
// are for people, and must not mislead them. If the part has a grasp or position with this label,
// its pose must be the pose in the action. A label that the part does not have is the plan's own,
// and is not checked.
std::vector<std::string> MisleadingLabels(const domain::Problem& problem, const Action& action);

}  // namespace assay::plan
