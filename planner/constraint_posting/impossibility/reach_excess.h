#pragma once

#include <optional>

#include "planner/domain/workcell/workcell.h"
#include "planner/plan/data/reason.h"

namespace assay::constraint_posting {

// Returns how far the tool is from the arm's first axis, and the greatest distance at which the arm
// reaches it when it is only moved straight toward this axis, up to a millimetre. Returns none if
// the arm reaches the pose itself, or no such pose.
std::optional<plan::Excess> ReachExcess(const domain::Workcell& workcell,
                                        const geometry::Pose& X_WorldTool);

}  // namespace assay::constraint_posting
