#pragma once

#include <memory>

#include "sim/execution/interpretation/interpretation.h"
#include "sim/execution/interpretation/planned_worlds.h"

namespace assay::execution {

// Returns the meaning of the contingent plan's words in the workcell. A look uses the camera to
// find which of its open poses a part has. Steps of plans are executed, verified and recovered by
// StepExecution. The audited predicates concern the present state:
// - pose(part) = p: of all poses that the part may have, it is nearest to p;
// - signals(step, e): the true value of the quantity that the step's verification measures means
// the error e. One predicate concerns past verifications and is not audited:
// - passed(step): the verifications after the step signalled nothing. This does not claim that the
//   step succeeded. The opening of the gripper does not show that a part has turned between the
//   pads, and the height of the tool does not show that a part leans. Later verifications or the
//   goal show these errors.
Interpretation InterpretationOf(std::shared_ptr<const PlannedWorlds> planned);

}  // namespace assay::execution
