#pragma once

#include <utility>
#include <vector>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/worlds/decision_diagram.h"

namespace assay::contingent {

// A function has one value: what gives it two at once is an error of the domain, and no plan has
// it.

// The function that the change gives a value; none if it gives none.
FunctionId FunctionGiven(const GroundTask& task, const GroundChange& change);
// Whether they give one function two values.
bool GiveTwoValues(const GroundTask& task, const GroundChange& a, const GroundChange& b);
// A change, and the worlds where it happens.
using ChangeSomewhere = std::pair<const GroundChange*, Diagram>;
// Where the changes give a function two values.
Diagram WhereTwoValues(const GroundTask& task, std::vector<ChangeSomewhere> changes,
                       DecisionDiagrams& diagrams);

}  // namespace assay::contingent
