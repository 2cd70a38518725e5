#pragma once

#include <numbers>

#include "planner/domain/problem/problem.h"

namespace assay::domain {

// How near its place a mated part must end for an assembly to be a success. Lengths in metres,
// angles in radians.

// The greatest distance that may remain along the mating vector. A millimetre is more than a feeler
// gauge shows and less than the eye sees. A part that has caught on a rim is centimetres off.
inline constexpr double kSeatedLimit = 0.001;
// The greatest angle between the axes. A shaft of 70 mm with a clearance of 0.5 mm cannot tilt by
// more than 0.8 degrees.
inline constexpr double kAxisAngleLimit = 1.5 * std::numbers::pi / 180;

// A shaft in its hole is off by no more than the clearance, along each side of the hole. This is
// the allowance beyond that, for penetration and for the tilt of the fixed part.
inline constexpr double kLateralSlack = 0.0002;
// The greatest alignment error, as a multiple of the clearance. The clearance lets the shaft move
// by up to 1.4 times its value, into a corner of the hole. The clearance lets the shaft turn,
// too. A hole of the part may be 1.5 times as far from the axis as the shaft's side, and the turn
// then moves this hole by 1.5 times the clearance.
inline constexpr double kAlignmentClearances = 3;

inline double GreatestClearance(const Problem& problem) {
  return problem.clearance + problem.tolerances.clearance;
}
// Returns the greatest displacement of the first pair of features along the x and y axes of the
// fixed part's feature.
inline double LateralLimit(const Problem& problem) {
  return GreatestClearance(problem) + kLateralSlack;
}
// Returns the greatest distance across the mating vector between the features of a later pair.
inline double AlignmentLimit(const Problem& problem) {
  return kAlignmentClearances * GreatestClearance(problem) + kLateralSlack;
}

}  // namespace assay::domain
