#pragma once

#include <optional>

#include "planner/plan/strategy.h"
#include "sim/exec/soft_arm.h"

namespace assay::exec {

// What an arm knows where a motion does not go on as planned.
struct Resistance {
  Vector6 wrench = Vector6::Zero();  // that the contacts exert on the tip
  Vector6 off = Vector6::Zero();     // the twist to the believed tip from where the motion leads
};

// The error state of the motion whose force signature the wrench is of (Dakin and Popplestone,
// sections 4 and 5), by what makes it one. None: the contacts of the plan explain the wrench as
// well, or no known error state does whose forces can be told from the plan's. That what the motion
// waits for has not come is no finding.
std::optional<plan::UnwantedContact> Recognize(const plan::Strategy& strategy,
                                               const plan::StrategyMotion& motion,
                                               const Resistance& felt);

}  // namespace assay::exec
