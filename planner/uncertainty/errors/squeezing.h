#pragma once

#include "planner/uncertainty/errors/uncertain_world.h"

namespace assay::uncertainty {

// Returns the error that is left in the hand after the pads have closed on a part that lies free
// (Spar, "The Propagation of Uncertainty by Actions").
//
// Paper mode: x and z are the displacement of the part's origin in the tool's axes; y and the
// rotation become the hand's.
//
// Sound mode: x and z are the displacement of the grasped point, in the frame of the true hand. The
// assumptions are:
//   - The pads turn the part until its faces lie flat on them, unless they jam before. Two pads
//     that touch a turned part at opposite ends hold it as it is if the line between the contacts
//     is within both friction cones (Nguyen 1988). A jammed part keeps at most the turn that it
//     had, and is not proved to be held.
//   - The friction of the surface that the part stands on does not keep it from turning until its
//     faces lie flat.
//   - The part turns about a point between the pads. The grasped point slips along the pads by no
//     more than it moves about the farthest point of this kind.
//   - Until the second pad touches, the first one pushes the part. It may turn the part further
//     where the centre of mass is not behind the pad, by at most 0.55 of the push over the radius
//     of gyration. That is the most by which a point contact can turn a sliding body that presses
//     on the table with uniform pressure. The factor is 0.5 if the pressure is on a ring, and less
//     if it is farther out.
//   - In a tool that leans, each of the tool's axes takes a share of the rotation about the
//     vertical.
HeldError ClosePads(UncertainWorld& world, PartId part, const plan::Hold& hold,
                    const ManipulatorError& draw);

}  // namespace assay::uncertainty
