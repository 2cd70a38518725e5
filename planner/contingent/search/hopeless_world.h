#pragma once

#include "planner/contingent/grounding/ground_task.h"

namespace assay::contingent {

// Looks for a world that the initial knowledge allows and in which no sequence of actions reaches
// the goal, although all facts are known. No tree reaches the goal in all worlds then, whatever its
// repeats are. Where an action makes a fact unknown, the sequence may choose whether the fact is
// true.
//
// Returns false if there is no such world, if numbers are involved, if more knowledge could do harm
// (IsMonotone), or if there are too many worlds or states to tell.
bool HasHopelessWorld(const GroundTask& task);

}  // namespace assay::contingent
