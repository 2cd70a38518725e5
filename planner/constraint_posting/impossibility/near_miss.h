#pragma once

#include <optional>
#include <vector>

#include "planner/constraint_posting/impossibility/relaxed_problem.h"
#include "planner/plan/data/reason.h"

namespace assay::constraint_posting {

// Returns by how little a constraint of a conflict fails: the hold or mating with which the problem
// would be possible if this constraint were waived for this hold or mating. If the constraint
// limits a quantity, the reason gives the least excess with which the problem would be possible. If
// the problem stays impossible without the constraint, only the constraints of the conflict are
// considered. If a condition without a measure fails for several holds that are needed together,
// the reason is about the nearest one. Returns none for a constraint that is about no hold and
// limits no quantity.
std::optional<plan::Reason> NearMissOf(const RelaxedProblem& relaxed,
                                       const std::vector<Constraint>& conflict,
                                       const Constraint& constraint);

}  // namespace assay::constraint_posting
