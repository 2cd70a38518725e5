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

}  // namespace assay::uncertainty
