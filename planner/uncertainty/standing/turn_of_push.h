#pragma once

#include "planner/uncertainty/error_sets/uncertain_world.h"

namespace assay::uncertainty {

// Returns the greatest turn, in radians up to pi, of a part that stands at X_WorldPart, while a
// push moves one of its points by `way` metres.
//
// The part slides on its support without inertia (Mason, "Mechanics and Planning of Manipulator
// Pushing Operations", 1986). A push with the lever p turns it by p / (p^2 + r^2) for each metre,
// which is at most 1 / (2 r). r is the greatest torque of the support's friction over its greatest
// force: the mean distance of the pressure from its centre. The factor here is 0.55 instead of 0.5.
//   - On a face, r is 0.85 of the radius of gyration of the face's area, which is less than the
//     mean distance under uniform pressure. If the centre of mass is nearer to the edge of the
//     support than the middle of the support is, r is smaller in the same proportion.
//   - On edges and corners, r is the distance of the nearest corner from the centre of mass.
//   - r is at most the radius of gyration of the mass.
double TurnOfPush(const UncertainWorld& world, PartId part, const Pose& X_WorldPart, double way);

struct Segment {  // in world x and y
  geometry::Vector2 from;
  geometry::Vector2 to;
};
// Returns the lever with which friction at its support resists a turn of a part that stands at
// X_WorldPart, in metres: the greatest mean distance of the pressure from the point of the turn.
// The part turns about the point of the segment that is nearest to its centre of mass. The moment
// of the weight fixes the mean of the pressure, but not where it acts.
double RadiusAgainstTurn(const UncertainWorld& world, PartId part, const Pose& X_WorldPart,
                         const Segment& about);

}  // namespace assay::uncertainty
