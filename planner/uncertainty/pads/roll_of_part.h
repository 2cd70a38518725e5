#pragma once

#include "planner/uncertainty/error_sets/uncertain_world.h"

namespace assay::uncertainty {

// How the pads find a standing part when they begin to turn it.
struct TurnedPart {
  double turn = 0;       // greatest turn of the part against the pads, radians
  double hand_turn = 0;  // greatest error of the hand's turn about the tool's axis, radians
  double off = 0;        // greatest displacement of the part along the pads, metres
};

// How far a part rolls about the direction in which the pads close.
struct Roll {
  double angle = 0;  // radians, up to pi
  double way = 0;    // path of the grasped point, metres
};

// Returns the greatest roll of a standing part while the pads turn it until its faces lie flat.
//
// Pads that lean, or that an error of the hand tilts, touch a turned part at points of different
// heights. Their forces N are then a couple that lifts the part on one side. While the part turns,
// it slides on the pads, and their friction mu N is a second couple about the closing direction.
// The two couples move the pressure of the support away from the centre of mass, in a direction
// whose slope against the closing direction is at most mu. The part tips about the edge of the
// support that the pressure reaches first.
//   - If this edge is at one of the part's ends, the part tilts about the horizontal direction
//     along the pads, until the pads touch it along edges of theirs or of its faces. An edge of the
//     support that is not quite along this direction makes the part roll by a share of the tilt.
//     The friction of the pads may be far greater than the part's weight. It then keeps the grasped
//     points at their height while the part tilts. The pressure may come to any edge between the
//     centre of mass and the pads. If the pads hold the part beside its support, it rolls about
//     the grasped points and a corner of the support.
//   - If the edge is along the closing direction, the part rolls without such an end. Only the work
//     of the pads bounds this roll: they press with N through the length that they close, and the
//     part slides on them against mu N. Points of contact that are a distance d from each other
//     along the pads close by d for each radian of the turn, and slide by d for each radian of the
//     roll. The roll is therefore at most the turn divided by the least friction of the pads.
Roll RollOfPart(const UncertainWorld& world, PartId part, const plan::Hold& hold,
                const TurnedPart& turned);

}  // namespace assay::uncertainty
