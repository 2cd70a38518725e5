#pragma once

#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"

namespace assay::plan {

// Returns, in words, the labels of the action that do not fit. The labels of grasps and positions
// are for people, and must not mislead them. A grasp or position that the part has must have its
// label. Another one has a label of the plan's own, which must not be empty or one of the part's.
std::vector<std::string> MisleadingLabels(const domain::Problem& problem, const Action& action);

}  // namespace assay::plan
