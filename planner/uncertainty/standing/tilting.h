#pragma once

#include "planner/plan/data/plan.h"
#include "planner/uncertainty/error_sets/uncertain_world.h"

namespace assay::uncertainty {

// Returns the greatest movement of the grasped point, in metres along the tool's axes, when a part
// that stands follows pads that lean by the hand's error. The part then tilts by up to `tilt`
// radians about the horizontal that the approach vector is above. It rises, because it stays on an
// edge of its support, however far from the pads this edge is. `off` is by how much the part may be
// displaced along the pads.
Vector3 MovedByTilt(const UncertainWorld& world, PartId part, const plan::Hold& hold, double tilt,
                    double off);

// Returns the greatest turn about the vertical for each radian of the fall of a part that leans and
// falls back on its support. X_WorldPart is the pose in which the part stands.
//
// The part falls about an axis that is not a principal one of its inertia. The pads as they leave,
// and the corners that touch one after the other, determine which horizontal axis it is. On a
// smooth support, no force has a moment about the vertical through the centre of mass. On a rough
// support that holds a corner, none has a moment about the vertical through this corner. The
// angular momentum about this vertical stays zero, so the part turns about it.
double TurnByFall(const UncertainWorld& world, PartId part, const Pose& X_WorldPart);

}  // namespace assay::uncertainty
