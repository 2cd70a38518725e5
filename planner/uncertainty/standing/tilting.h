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

// The greatest motion of a part, for each radian by which it leans, that is let go and falls back
// on its support.
struct Fall {
  double turn = 0;  // radians about the vertical
  double way = 0;   // of the part's origin, metres
};
// Returns the motion of a part that falls to X_WorldPart, the pose in which it stands.
//
// The part falls about an axis that is not a principal one of its inertia. The pads as they leave,
// and the corners that touch one after the other, determine which horizontal axis it is. On a
// smooth support, no force has a moment about the vertical through the centre of mass. On a rough
// support that holds a corner, none has a moment about the vertical through this corner. The
// angular momentum about this vertical stays zero, so the part turns about it.
//
// Then the part may rock from side to side. Each corner that strikes a rough support may push the
// part, which turns until the next corner strikes. The energy of the fall bounds the speed of this
// turn, and each stroke leaves less energy (Housner, "The behavior of inverted pendulum structures
// during earthquakes", 1963). The energies are those of a part that rocks between an edge and the
// opposite corner. It is an assumption that rocking from corner to corner turns a part no farther:
// 360 random parts, simulated by impulses, turned by at most 0.76 of the bound.
//
// A turn about a corner of the support moves the part's origin.
Fall FallOf(const UncertainWorld& world, PartId part, const Pose& X_WorldPart);

}  // namespace assay::uncertainty
