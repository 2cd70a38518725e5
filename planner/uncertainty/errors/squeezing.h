#pragma once

#include "planner/uncertainty/errors/uncertain_world.h"

namespace assay::uncertainty {

// What closing the pads on a part that lies free leaves of its errors (Spar, "The Propagation of
// Uncertainty by Actions").
//
// Paper: the displacement of the part's origin in the tool's axes; y and the rotation become the
// hand's.
//
// Sound: the displacement of the grasped point, in the frame of the true hand. What is assumed:
//   - The pads turn the part until its faces lie flat on them, unless they jam before: two pads
//     that touch a turned part at opposite ends hold it as it is, if the line between the contacts
//     is within both friction cones (Nguyen 1988). Jammed, it keeps at most the turn it had, and is
//     not proved to be held.
//   - The friction of what it stands on does not keep it from turning until its faces lie flat.
//   - It turns about a point between the pads: the grasped point slips along them by no more than
//     the way that it makes about the farthest such point.
//   - Until the second pad touches, the first one pushes the part, and may turn it further where
//     the centre of mass is not behind the pad: by at most 0.55 of the push over the radius of
//     gyration. So much a point contact can turn a sliding body that presses on the table with
//     uniform pressure; 0.5 if the pressure is on a ring, less if it is farther out.
//   - A tool that leans finds a part of the rotation about the vertical about each of its axes.
HeldError ClosePads(UncertainWorld& world, PartId part, const plan::Hold& hold,
                    const ManipulatorError& draw);

}  // namespace assay::uncertainty
