#pragma once

#include "planner/domain/problem/problem.h"

namespace assay::plan {

// How hard parts are pushed: certificates build on these numbers, and whoever moves the arm keeps
// to them. Newtons.

// At which a guarded move stops.
inline constexpr double kResistance = 15;
// The most that a guarded move exerts until the arm is at rest, for longer than an impact.
inline constexpr double kGreatestPush = 30;
// Along a crevice, at most, by a strategy of fine motion; no contact of it is pressed harder.
inline constexpr double kStrategyPush = 25;

// Whether closed pads surely bear what stops a guarded move. Else they may slide down on the part
// that has met something, and the move goes on.
inline bool PadsBearResistance(const domain::Problem& problem) {
  const domain::WorkcellRules& rules = problem.workcell->rules();
  const double friction = rules.pad_friction - problem.tolerances.pad_friction;
  return 2 * friction * rules.grip_force > kResistance;
}

// By how much farther than a contact may be a guarded move goes, metres: what arm and pads give
// way.
inline constexpr double kBeyondContact = 2e-4;

}  // namespace assay::plan
