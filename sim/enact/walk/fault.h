#pragma once

#include <string>
#include <variant>
#include <vector>

#include "sim/enact/walk/plan_interpretation.h"

namespace assay::enact {

// An error that may be signalled after a step of a plan.
struct StepError {
  std::string step;  // as the tree has it
  std::string error;
};

// Those of the world's plan, in the order of its verifications.
std::vector<StepError> ErrorsOf(const PlannedWorlds& planned, int world);

// What makes the step's verification signal the error, beyond all that is believed possible: the
// part is taken away before it is grasped, or turned so that the pads close on its corners; it
// slips in the hand before it is put down; the fixed part is taken away before something is mated
// with it, or moved aside, so that the peg stops at the rim. Or, in words, why nothing surely does.
std::variant<Fault, std::string> FaultFor(const PlannedWorlds& planned, int world,
                                          const StepError& error, RandomStream& random);

}  // namespace assay::enact
