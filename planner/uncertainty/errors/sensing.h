#pragma once

#include "planner/uncertainty/errors/uncertain_world.h"

namespace assay::uncertainty {

// Whether a coordinate that is known to within `known` is taken from a sensor that promises
// `promise`: if that is narrower. An executor must decide alike, with the step's certificate for
// what is known: another belief has other errors.
bool TakesOver(const Interval& known, const Interval& promise);

// The add and delete lists of a sensing action: each coordinate of the part's error that the sensor
// measures better than it is known is replaced by a new variable within the sensor's promise. What
// is believed of the pose is from then on what was measured, coordinate by coordinate in the
// world's axes.
//
// Paper mode leaves out that the plan's poses turn with the belief.
void ApplySensing(UncertainWorld& world, PartId part, const std::string& sensor);

}  // namespace assay::uncertainty
