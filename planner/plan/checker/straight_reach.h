#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/domain/workcell/workcell.h"
#include "planner/plan/data/plan.h"

namespace assay::plan {

// Poses of the tool in the world, close together on a straight line. All lines of one action start
// at the pose where the pads open or close.
using ToolLine = std::vector<Pose>;

// Returns the line of `intervals` + 1 poses from X_WorldTool to the pose displaced by
// `displacement` (metres, world).
ToolLine LineFrom(const Pose& X_WorldTool, const geometry::Vector3& displacement, int intervals);

// Checks whether the arm can follow every line from one joint vector at their common start. Returns
// the reason why it cannot, or none if it can. The closed form of the inverse kinematics only
// proposes joint vectors. A joint vector counts if it is within the arm's limits and brings the
// tool to the pose to 1e-6. From one pose to the next, no joint may turn by more than 20 degrees.
std::optional<std::string> WhyOutOfReach(const domain::Workcell& workcell,
                                         std::span<const ToolLine> lines);

}  // namespace assay::plan
