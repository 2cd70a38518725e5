#pragma once

#include "planner/base/budget.h"
#include "planner/contingent/grounding/ground_task.h"

namespace assay::contingent {

// Looks for a world that the initial knowledge allows and in which no sequence of actions reaches
// the goal, although all facts are known. No tree reaches the goal in all worlds then, whatever its
// repeats are. Where an action makes a fact unknown, the sequence may choose whether the fact is
// true.
//
// Returns false if there is no such world, if numbers are involved, if more knowledge could do harm
// (IsMonotone), if effects assert something (a world that contradicts it would be ruled out), or if
// there are too many worlds or states to tell. Each state takes one unit of the budget.
bool HasHopelessWorld(const GroundTask& task, Budget& budget);

}  // namespace assay::contingent
