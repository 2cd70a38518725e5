#pragma once

#include "planner/uncertainty/uncertain_world.h"

namespace assay::uncertainty {

// The add and delete lists of a sensing action: each coordinate of the part's error that the sensor
// measures better than it is known is replaced by a new variable within the sensor's promise. What
// is believed of the pose is from then on what was measured.
//
// Sound mode: the plan goes on with the measured pose in place of the planned one, turned from it
// by anything up to the old error. Errors are told in the axes of the planned pose, so the
// sensor's, which are the world's, turn back by as much.
void ApplySensing(UncertainWorld& world, PartId part, const std::string& sensor);

}  // namespace assay::uncertainty
