#pragma once

#include "planner/uncertainty/errors/uncertain_world.h"

namespace assay::uncertainty {

// The error of a part on the table once the hand has let it go where it thinks is X_WorldPart;
// X_ToolGrasp is T'_d. Its displacement is that of the part in the hand: what the part lands on
// replaces a component.
//
// A part that comes upright has the hand's rotation, and what it was skewed in the hand. A tool
// that leans turns the part about its own axis: the table, or the seat of a mating, sets it upright
// again while the pads still hold it (paper mode leaves that out).
bool ComesUpright(const UncertainWorld& world, const plan::Hold& hold, const Pose& X_WorldPart);

// What the errors of hand and grasp make of a part whose tool sees the vertical as `up`: how far it
// leans, what turn about the vertical is left of it once the table has levelled it, and the angle
// of that levelling, by which its points move. Radians.
//
// The axis of the levelling is the pads' to choose: they resist turns about the tool's axes, each
// in its own measure. A hand that leans by a and errs by theta about its approach may leave the
// part turned by theta / cos a, if the pads give way across the approach, or not at all, if about
// it.
struct Leaning {
  double tilt = 0;
  double twist = 0;
  double levelling = 0;
};
Leaning LeaningOf(const UncertainWorld& world, const Vector3& up, const ManipulatorError& draw);

// Metres that pads go down on a part that already stands: none if they bear what stops them.
// `released`: its error, once it is let go.
double SlideOfPads(const UncertainWorld& world, const ManipulatorError& draw,
                   const RestingError& released);

RestingError Release(UncertainWorld& world, PartId part, const plan::Hold& hold,
                     const Transform& X_ToolGrasp, const ManipulatorError& draw,
                     const Pose& X_WorldPart);

// The same of a part that was mated. Along the mating motion it stands where its seat is, which is
// displaced like the fixed part; across, the wrist may have yielded.
RestingError ReleaseInSeat(UncertainWorld& world, domain::MatingId mating, const plan::Hold& hold,
                           const Transform& X_ToolGrasp, const ManipulatorError& draw);

// The same of a part that a strategy has led in: the walls have it, whatever the hand does, so that
// it is displaced like the fixed part, but for the play between them.
RestingError LedToSeat(UncertainWorld& world, domain::MatingId mating);

// What lands leaning in its seat, or yields to the seat's walls, drags the fixed part along by as
// much where friction between the two is more than what keeps the fixed part: that becomes an error
// of the fixed part.
struct Drag {
  double way = 0;   // metres, along x and along y
  double turn = 0;  // radians
};
Drag DragOfFixed(const UncertainWorld& world, domain::MatingId mating, const plan::Hold& hold,
                 const ManipulatorError& draw);
void DragFixed(UncertainWorld& world, domain::MatingId mating, const plan::Hold& hold,
               const ManipulatorError& draw);

}  // namespace assay::uncertainty
