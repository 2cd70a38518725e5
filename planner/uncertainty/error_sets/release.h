#pragma once

#include "planner/uncertainty/error_sets/uncertain_world.h"

namespace assay::uncertainty {

// Returns whether the part comes upright to X_WorldPart, its believed pose when the hand lets it
// go. An upright part keeps the hand's rotation, and its own skew in the hand. A tool that leans
// turns the part about the tool's own axis. The table, or the seat of a mating, then sets the part
// upright again while the pads still hold it. (Paper mode leaves this levelling out.)
bool ComesUpright(const UncertainWorld& world, const plan::Hold& hold, const Pose& X_WorldPart);

// The effect of the errors of hand and grasp on a part that comes down leaning. Angles are in
// radians.
//
// The axis of the levelling depends on the pads: they resist turns about each of the tool's axes by
// a different amount. Let the hand lean by a, and err by theta about its approach vector. If the
// pads give way across the approach vector, the part may be left turned by theta / cos a. If they
// give way about the approach vector, the part may not be turned at all.
struct Leaning {
  double tilt = 0;   // how far the part leans
  double turn = 0;   // turn about the vertical before the table levels the part
  double twist = 0;  // turn about the vertical that is left after the levelling between the pads
  double levelling = 0;  // angle of the levelling, by which the part's points move
};
// Returns the leaning of a part whose tool has the vertical `up` in its axes. `draw` is the hand's
// error.
Leaning LeaningOf(const UncertainWorld& world, const Vector3& up, const ManipulatorError& draw);

// Returns how much of a standing part's error comes from pads that slide down on the part, in
// metres. The result is 0 if the pads bear the force that stops a guarded move
// (plan::PadsBearResistance). `released` is the error of the part after the hand has let it go.
double SlideOfPads(const UncertainWorld& world, const ManipulatorError& draw,
                   const RestingError& released);

// Returns the error of a part on the table after the hand has let the part go. X_WorldPart is its
// believed pose at that time, and X_ToolGrasp is T'_d. The displacement is the displacement of the
// part in the hand. The caller replaces the component that the surface under the part determines.
RestingError Release(UncertainWorld& world, PartId part, const plan::Hold& hold,
                     const Transform& X_ToolGrasp, const ManipulatorError& draw,
                     const Pose& X_WorldPart);

// Returns the error of a part that is lowered to the table and let go there. Pads may slide down on
// the part (SlideOfPads). If the direction in which they close is not horizontal, they push the
// part aside like a wedge, by as much as they come nearer to it.
RestingError ReleaseOnTable(UncertainWorld& world, PartId part, const plan::Hold& hold,
                            const Transform& X_ToolGrasp, const ManipulatorError& draw,
                            const Pose& X_WorldPart);

// Returns the error of a part after the hand has let it go in the seat of a mating. Along the
// mating motion the part stands where its seat is, and the seat is displaced like the fixed part.
// Across the motion, the wrist may have yielded.
RestingError ReleaseInSeat(UncertainWorld& world, domain::MatingId mating, const plan::Hold& hold,
                           const Transform& X_ToolGrasp, const ManipulatorError& draw);

// Returns the error of a part that a strategy has led into its seat. The walls hold the part there,
// whatever the hand does. So it is displaced like the fixed part, plus the play between the two.
RestingError LedToSeat(UncertainWorld& world, domain::MatingId mating);

}  // namespace assay::uncertainty
