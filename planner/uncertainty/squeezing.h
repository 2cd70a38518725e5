#pragma once

#include "planner/uncertainty/uncertain_world.h"

namespace assay::uncertainty {

// What closing the pads on a part that lies free leaves of its errors (Spar, "The Propagation of
// Uncertainty by Actions").
//
// Paper: the displacement of the part's origin in the tool's axes; y and the rotation become the
// hand's.
//
// Sound: the displacement of the grasped point, in the frame of the true hand. The pads turn the
// part until its faces lie flat on them. It turns about a point between the pads, because with less
// than the friction angle between pad and face one contact sticks; so the grasped point slips along
// the pads by at most (width / 2) sin(turn) + (pad / 2) (1 - cos(turn)). Before the second pad
// touches, the first one pushes the part, and where the part's centre of mass is not within the pad
// it may turn further by the push over twice its radius of gyration (the most that a point contact
// can turn a sliding body per distance pushed). A tool that leans finds only a part of the rotation
// about the world's z along its own axes; what is about the closing direction stays (twist).
HeldError ClosePads(UncertainWorld& world, PartId part, const plan::Hold& hold,
                    const ManipulatorError& draw);

}  // namespace assay::uncertainty
