#pragma once

#include <utility>
#include <vector>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/world_sets/decision_diagram.h"

namespace assay::contingent {

// A function has one value. An effect that gives it two values at once is an error of the domain,
// and no plan contains it.

// Returns the function to which the change gives a value, or none if it gives none.
FunctionId FunctionGiven(const GroundTask& task, const GroundChange& change);
// Returns true if the two changes give one function two different values, which the planning
// language does not allow.
bool GiveTwoValues(const GroundTask& task, const GroundChange& a, const GroundChange& b);
// A change, and the worlds in which it happens.
using ChangeSomewhere = std::pair<const GroundChange*, Diagram>;
// Returns the worlds in which the changes give a function two values.
Diagram WhereTwoValues(const GroundTask& task, std::vector<ChangeSomewhere> changes,
                       DecisionDiagrams& diagrams);

}  // namespace assay::contingent
