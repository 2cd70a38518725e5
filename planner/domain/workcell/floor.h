#pragma once

#include "planner/domain/workcell/workcell.h"

namespace assay::domain {

// Returns the height of the floor in the world, in metres. It is the underside of the lowest shape
// of the robots' roots, but not above the underside of any table. Collision shapes count; visible
// ones are used for a root that has no collision shapes.
double FloorHeight(const Workcell& workcell);

}  // namespace assay::domain
