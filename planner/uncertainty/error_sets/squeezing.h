#pragma once

#include "planner/uncertainty/error_sets/uncertain_world.h"

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
//     had, and is not proved to be held. If the part is turned so far that the pads press beside
//     each other on it, they may turn it away from its faces.
//   - Pads that are wider than the faces touch what both of them reach opposite each other.
//   - Pads that close from above on a side that is round about the vertical leave the part's turn,
//     and its axis comes midway between them. The first pad may push the part along itself by the
//     pads' friction times its push, or twice as far.
//   - The friction of the surface that the part stands on stops its turn before its faces lie flat
//     on the pads only if its moment takes up what the grip has left over the friction of the pads.
//     The part then counts as jammed.
//   - The part turns about a point on the line through the middle of the pads in the direction in
//     which they close: both pads move equally. The point lies between the pads, or up to the
//     centre of mass if the pads' friction is too small for the support's. The grasped point slips
//     along the pads by no more than it moves about the farthest point of this kind.
//   - Until the second pad touches, the first one pushes the part. It may turn the part further
//     where the centre of mass is not behind the pad (TurnOfPush).
//   - The friction of a heavy part moves the hand, because its servos yield. The part is left off
//     by as much across the pads, and along them.
//   - A part that is turned may roll about the closing direction (RollOfPart).
//   - In a tool that leans, a rotation about the vertical has a component about each of the tool's
//     axes. A part whose faces follow the hand's own error then tilts, on an edge of its support.
HeldError ClosePads(UncertainWorld& world, PartId part, const plan::Hold& hold,
                    const ManipulatorError& draw);

// Returns the greatest turn, in radians, that the first pad may give the part before the second one
// touches.
double TurnBeforeGrasp(const UncertainWorld& world, PartId part, const plan::Hold& hold,
                       const ManipulatorError& draw);

}  // namespace assay::uncertainty
