#pragma once

#include "planner/uncertainty/error_sets/uncertain_world.h"

namespace assay::uncertainty {

// Returns whether sensing replaces a coordinate that is known to within `known`: it does if the
// sensor's `promise` is narrower. An executor must decide in the same way, and read `known` from
// the step's certificate. Otherwise its believed pose has other errors than those that were
// certified.
bool TakesOver(const Interval& known, const Interval& promise);

// Applies the add and delete lists of a sensing action. Each coordinate of the part's error that
// the sensor measures better than it is known is replaced by a new variable within the sensor's
// promise. From then on the believed pose is the measured one, coordinate by coordinate in the
// world's axes.
//
// Paper mode does not turn the plan's poses with the believed pose.
void ApplySensing(UncertainWorld& world, PartId part, const std::string& sensor);

}  // namespace assay::uncertainty
