#pragma once

#include <vector>

#include "planner/domain/problem/problem.h"

namespace assay::domain {

// Returns the GraspList of assemble as labels: the grasps of the held part that hide none of its
// mating features (Spar, "A Task Planning Example").
std::vector<int> GraspList(const Problem& problem, const Mating& mating);

// Returns the PositionList of assemble as labels: the stable poses of the fixed part that hide none
// of its mating features and put the mating vector inside the friction cone. The pose at the start
// is in the list if the stable pose that it corresponds to is.
std::vector<int> PositionList(const Problem& problem, const Mating& mating);

}  // namespace assay::domain
