#pragma once

#include <vector>

#include "planner/domain/actions/action_kind.h"

namespace assay::domain {

extern const ActionKind kPickup;
extern const ActionKind kPutdown;
extern const ActionKind kAssemble;
// A sensor of the workcell looks at a part. Afterwards the error of the part's believed pose is
// the sensor's error.
extern const ActionKind kSense;
// The pads close on a part and open again, to bring it to where the hand is. This manipulation
// reduces uncertainty (Spar, "Satisfying Uncertainty-Reduction Goals").
extern const ActionKind kSqueeze;

using ActionKinds = std::vector<const ActionKind*>;

// Returns the kinds of action that every problem has. The planner tries them in this order.
const ActionKinds& StandardActions();

}  // namespace assay::domain
