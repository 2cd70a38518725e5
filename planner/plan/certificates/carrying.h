#pragma once

namespace assay::plan {

// Limits of the motion of a part in the hand. Certificates rely on these numbers, and everything
// that moves the arm must keep to them.

// Greatest acceleration of the part's centre of mass, m/s^2.
inline constexpr double kCarryingAcceleration = 1.5;
// Greatest turning of the hand: angular acceleration and squared angular velocity together,
// rad/s^2.
inline constexpr double kCarryingTurn = 5.0;

}  // namespace assay::plan
