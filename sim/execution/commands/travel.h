#pragma once

#include <span>

#include "planner/motion/paths/travel.h"
#include "sim/execution/robots/execution.h"

namespace assay::execution {

// Returns the request for a planned travel (motion::PlanTravel) that this command makes. `rest`
// holds the commands that follow in its step.
motion::TravelRequest RequestFor(const MoveAtSafeHeight& move, std::span<const Command> rest,
                                 const Execution& execution);

// Commands the arm to follow the planned travel. If there is none, it returns the reason.
Progress Go(const motion::TravelResult& travel, Execution& execution);

}  // namespace assay::execution
