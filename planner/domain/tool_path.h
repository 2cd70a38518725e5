#pragma once

#include <span>

#include "planner/domain/workcell.h"

namespace assay::domain {

// Whether the arm can move the tool, its orientation kept, along the straight lines from corner to
// corner (origins of the tool, world frame; at least one) within its joint limits and without
// changing its configuration or turning a joint by leaps on the way. Looked at in steps of a few
// centimetres.
bool CanFollow(const Workcell& workcell, const geometry::Matrix3& R_WorldTool,
               std::span<const geometry::Vector3> corners);

}  // namespace assay::domain
