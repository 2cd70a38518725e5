#pragma once

#include <string>
#include <variant>
#include <vector>

#include "sim/execution/interpretation/plan_interpretation.h"

namespace assay::execution {

// An error that a verification may signal after a step of a plan.
struct StepError {
  std::string step;  // the step's name in the tree
  std::string error;
};

// Returns the errors that the verifications of the world's plan may signal, by the names of the
// steps.
std::vector<StepError> ErrorsOf(const PlannedWorlds& planned, int world);

// Draws a fault that makes the step's verification signal the error. The fault exceeds all error
// bounds of the plan. Returns the reason in words if no fault surely causes the error. The faults:
// - before a grasp the part is taken away, or turned so that the pads close on its corners;
// - before a putdown the part slips in the hand;
// - before a mating the fixed part is taken away, or moved so that the peg stops at the rim.
std::variant<Fault, std::string> FaultFor(const PlannedWorlds& planned, int world,
                                          const StepError& error, RandomStream& random);

}  // namespace assay::execution
