#pragma once

#include <string>
#include <vector>

#include "planner/constraint_posting/impossibility/relaxed_problem.h"

namespace assay::constraint_posting {

// Returns one text for each constraint of a conflict that limits a quantity, in the order of the
// conflict. A text gives, with values and units, the least excess with which the problem would be
// possible, and the hold or mating that would then be used. If the problem stays impossible without
// the constraint, only the constraints of the conflict are considered.
std::vector<std::string> NearMisses(const RelaxedProblem& relaxed,
                                    const std::vector<Constraint>& conflict);

}  // namespace assay::constraint_posting
