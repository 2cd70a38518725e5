#pragma once

namespace assay::plan {

// What a part in the hand is spared on its way: certificates build on these numbers, and whoever
// moves the arm keeps to them.

// Of the part's centre of mass, m/s^2.
inline constexpr double kCarryingAcceleration = 1.5;
// Of the hand's turning: angular acceleration and squared angular velocity together, rad/s^2.
inline constexpr double kCarryingTurn = 5.0;

}  // namespace assay::plan
