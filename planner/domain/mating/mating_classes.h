#pragma once

#include <vector>

#include "planner/domain/problem/problem.h"

namespace assay::domain {

// GraspList of assemble: the grasps of the held part that hide none of its mating features, as
// labels (Spar, "A Task Planning Example").
std::vector<int> GraspList(const Problem& problem, const Mating& mating);

// PositionList of assemble: the stable poses of the fixed part that hide none of its mating
// features and put the mating vector inside the friction cone, as labels. The pose at the start is
// in the class if the stable pose that it corresponds to is.
std::vector<int> PositionList(const Problem& problem, const Mating& mating);

}  // namespace assay::domain
