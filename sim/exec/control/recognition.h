#pragma once

#include <optional>

#include "planner/plan/data/strategy.h"
#include "sim/exec/control/soft_arm.h"

namespace assay::exec {

// Contact states are told apart by their force signatures (Dakin and Popplestone, section 5: the
// next state's signature is what ends a motion, and those of error states come with the plan). The
// paper does not say how a wrench is compared with signatures. Here each state has a likelihood,
// told as the exponent's sum of squares:
//
// - by what angle the wrench is outside the state's cone of wrenches, friction and all; contacts
//   may be moved to where they explain more, which has its price: edges that are nearly parallel
//   touch centimetres beside where they are planned;
// - of error states, by how much all errors must be enlarged for the state to come about (section
//   4: the likelihood is inversely related to that).
//
// Where a part is believed to be does not tell contacts apart: in an error state that is what is
// wrong. Neither is anything told by a contact that touches and bears nothing.

// Whether what is felt after a motion is of the contacts that the plan then has. Less than a newton
// is of any.
bool IsAsPlanned(const plan::Strategy& strategy, const plan::StrategyMotion& motion,
                 const Vector6& wrench);

// The likeliest error state of the motion in which the tip bears the wrench, by what makes it one.
// A contact that was made must explain the wrench, and the planned ones must not; one that was lost
// must not be needed. None: no known error state does, of those whose forces can be told from the
// plan's. That what the motion waits for has not come is no finding.
std::optional<plan::UnwantedContact> Recognize(const plan::Strategy& strategy,
                                               const plan::StrategyMotion& motion,
                                               const Vector6& wrench);

}  // namespace assay::exec
