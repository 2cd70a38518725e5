#pragma once

#include <optional>

#include "planner/domain/workcell/workcell.h"

namespace assay::domain {

// Returns the height of the underside of a link that stands at X_WorldLink, in metres. Collision
// shapes count; visible ones are used for a link that has no collision shapes. Returns none for a
// link without shapes.
std::optional<double> UndersideOf(const kinematics::Link& link, const geometry::Pose& X_WorldLink);

// Returns the height of the floor in the world, in metres. It is the underside of the lowest shape
// of the robots' roots (UndersideOf), but not above the underside of any table.
double FloorHeight(const Workcell& workcell);

}  // namespace assay::domain
