#pragma once

#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"

namespace assay::plan {

// Returns, in words, the labels of the action that do not fit. The labels of grasps and positions
// are for people, and must not mislead them. A grasp or position that the part has must have its
// label. Any other grasp or position has a label of the plan's own, which must be neither empty nor
// one of the part's labels.
std::vector<std::string> MisleadingLabels(const domain::Problem& problem, const Action& action);

}  // namespace assay::plan
