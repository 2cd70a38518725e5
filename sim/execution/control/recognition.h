#pragma once

#include <optional>

#include "planner/plan/data/strategy.h"
#include "sim/execution/control/soft_arm.h"

namespace assay::execution {

// Contact states are distinguished by their force signatures (Dakin and Popplestone, section 5).
// The signature of the next state ends a motion, and the plan holds the signatures of the error
// states. The paper does not say how a wrench is compared with signatures. Here each state has a
// likelihood, expressed as the sum of squares in its exponent:
//
// - The angle by which the wrench is outside the state's cone of wrenches, friction included.
//   Contacts may be moved to places where they explain more, at a cost, because nearly parallel
//   edges touch centimetres from their planned places.
// - For error states, the factor by which all errors must be enlarged to cause the state. The
//   likelihood falls with this factor (section 4).
//
// The believed pose of the part is not used to distinguish contacts, because this pose is wrong in
// an error state. A contact that touches and bears nothing gives no information.

// Returns whether the wrench that is measured after a motion of a strategy can come from the
// planned contacts. A wrench of less than a newton can come from any contacts.
bool IsAsPlanned(const plan::Strategy& strategy, const plan::StrategyMotion& motion,
                 const Vector6& wrench);

// Returns the likeliest error state of the motion in which the tip bears the wrench, as the
// unwanted contact that causes it. A contact that was made must explain the wrench while the
// planned ones do not. A contact that was lost must not be needed to explain it. Only error states
// are considered whose forces differ enough from the planned ones. Returns none if none of them
// explains the wrench. An awaited contact that has not come is not reported.
std::optional<plan::UnwantedContact> Recognize(const plan::Strategy& strategy,
                                               const plan::StrategyMotion& motion,
                                               const Vector6& wrench);

}  // namespace assay::execution
