#pragma once

#include <vector>

#include "planner/domain/parts/part_model.h"
#include "planner/domain/resting/stable_pose.h"

namespace assay::domain {

// Returns the stable poses: the hull facets over which the centre of mass lies, at least
// `least_tilt` radians from tipping, in the order of the hull's facets. Yaw 0 is defined by the
// first of the part's x, y, z axes that leans more than 45 degrees away from the vertical.
// Projected onto the table, this axis points along the table's x.
std::vector<StablePose> ComputeStablePoses(const PartModel& part, double least_tilt);

}  // namespace assay::domain
