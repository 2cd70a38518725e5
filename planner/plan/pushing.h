#pragma once

namespace assay::plan {

// How hard parts are pushed: certificates build on these numbers, and whoever moves the arm keeps
// to them. Newtons.

// At which a guarded move stops.
inline constexpr double kResistance = 15;
// The most that a guarded move exerts until the arm is at rest, for longer than an impact.
inline constexpr double kGreatestPush = 30;
// Along a crevice, at most, by a strategy of fine motion; no contact of it is pressed harder.
inline constexpr double kStrategyPush = 25;

// By how much farther than a contact may be a guarded move goes, metres: what arm and pads give
// way.
inline constexpr double kBeyondContact = 2e-4;

}  // namespace assay::plan
