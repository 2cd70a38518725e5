#pragma once

#include "planner/domain/workcell/workcell.h"

namespace assay::domain {

// The height of the floor in the world, metres: where the lowest shape of the robots' roots stands
// (of those for collision, or of the visible ones if there are none), and nowhere above the
// underside of a table.
double FloorHeight(const Workcell& workcell);

}  // namespace assay::domain
