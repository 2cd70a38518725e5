#pragma once

#include <optional>

#include "planner/domain/workcell/workcell.h"
#include "planner/plan/data/reason.h"

namespace assay::constraint_posting {

// Returns two distances from the arm's first axis: that of the pose, and the greatest distance at
// which the arm would reach the pose if the pose were moved straight toward the axis. The second
// distance is exact to a millimetre. Returns none if the arm reaches the pose where it is, or
// reaches no pose on the way to the axis.
std::optional<plan::Excess> ReachExcess(const domain::Workcell& workcell,
                                        const geometry::Pose& X_WorldTool);

}  // namespace assay::constraint_posting
