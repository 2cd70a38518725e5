#pragma once

#include <span>

#include "planner/motion/path/travel.h"
#include "sim/exec/execution/execution.h"

namespace assay::exec {

// What is asked of the planner of travels for the command; `rest`: those that follow in its step.
motion::TravelRequest RequestFor(const MoveAtSafeHeight& move, std::span<const Command> rest,
                                 const Execution& execution);

// The arm goes as was planned, or why it does not.
Progress Go(const motion::TravelResult& travel, Execution& execution);

}  // namespace assay::exec
