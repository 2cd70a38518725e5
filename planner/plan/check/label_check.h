#pragma once

#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"

namespace assay::plan {

// Labels of grasps and positions are for people, who are not to be misled: one that the part has
// must be that of the pose it stands beside. The labels that do not fit, in words. Labels of the
// plan's own, which the part has not, say nothing.
std::vector<std::string> MisleadingLabels(const domain::Problem& problem, const Action& action);

}  // namespace assay::plan
