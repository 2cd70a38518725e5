#pragma once

#include <span>

#include "sim/execution/commands/command.h"
#include "sim/execution/robots/execution.h"

namespace assay::execution {

// Execute a command of a step (one file for each). `rest` holds the commands that follow in the
// same step.
Progress Run(const MoveAtSafeHeight& move, std::span<const Command> rest, Execution& execution);
Progress Run(const FollowPath& follow, std::span<const Command> rest, Execution& execution);
Progress Run(const MoveStraight& move, std::span<const Command> rest, Execution& execution);
Progress Run(const OpenGripper& open, std::span<const Command> rest, Execution& execution);
Progress Run(const CloseGripper& close, std::span<const Command> rest, Execution& execution);
Progress Run(const Look& look, std::span<const Command> rest, Execution& execution);
Progress Run(const Clamp& clamp, std::span<const Command> rest, Execution& execution);
Progress Run(const FollowStrategy& follow, std::span<const Command> rest, Execution& execution);

}  // namespace assay::execution
