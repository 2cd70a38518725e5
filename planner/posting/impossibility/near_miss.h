#pragma once

#include <string>
#include <vector>

#include "planner/posting/impossibility/relaxed_problem.h"

namespace assay::posting {

// For each constraint of a conflict that limits a quantity: the least excess with which the
// problem, or if that is not enough the rest of the conflict, would be possible, and what would
// then be held or mated where. In words, with values and units, in the order of the conflict.
std::vector<std::string> NearMisses(const RelaxedProblem& relaxed,
                                    const std::vector<Constraint>& conflict);

}  // namespace assay::posting
