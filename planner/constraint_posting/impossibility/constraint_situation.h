#pragma once

#include <optional>

#include "planner/constraint_posting/impossibility/relaxed_problem.h"
#include "planner/plan/data/reason.h"

namespace assay::constraint_posting {

// Returns the situation in which a part is held. A stable pose is shown at the first placement of
// the workcell.
plan::Situation SituationOf(const RelaxedProblem& relaxed, const HoldOption& hold);

// Returns the situation in which two parts are mated, with the fixed part at a position.
plan::Situation MatedAt(const RelaxedProblem& relaxed, domain::MatingId mating, int position);

// Returns the situation that a constraint is about by itself: where its parts start, end or are
// mated. Grasp conditions are about no single situation.
std::optional<plan::Situation> SituationOf(const RelaxedProblem& relaxed,
                                           const Constraint& constraint);

}  // namespace assay::constraint_posting
