#pragma once

#include "planner/domain/problem/problem.h"
#include "planner/plan/certificates/certificate.h"

namespace assay::plan {

// Limits of the forces that push parts, in newtons. Certificates rely on these numbers, and
// everything that moves the arm must keep to them.

// Force at which a guarded move stops.
inline constexpr double kResistance = 15;
// Greatest force of a guarded move until the arm is at rest, apart from short impacts.
inline constexpr double kGreatestPush = 30;
// Greatest force of a fine-motion strategy along a crevice. None of its contacts is pressed harder.
inline constexpr double kStrategyPush = 25;

// Returns whether certificates may assume that closed pads bear the force that stops a guarded
// move. If the pads do not bear this force, they may slide down on the held part after it has met
// an obstacle, so that the move does not stop.
inline bool PadsBearResistance(const domain::Problem& problem) {
  const domain::WorkcellRules& rules = problem.workcell->rules();
  const double friction = rules.pad_friction - problem.tolerances.pad_friction;
  return 2 * friction * rules.grip_force > kResistance;
}

// The distance, in metres, by which a guarded move goes beyond the farthest possible contact. Arm
// and pads give way by this distance.
inline constexpr double kBeyondContact = 2e-4;

// Returns how far a guarded move goes beyond the place of expected contact, in metres. It goes
// until contact must have been made, so that pads that bear less than the resistance slide no
// farther on the part. It goes no farther than the workcell's guarded travel. `certificate` is that
// of the step; it is empty if nothing is known.
double BeyondContact(const domain::Problem& problem, const Certificate& certificate);

}  // namespace assay::plan
