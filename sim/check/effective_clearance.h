#pragma once

#include <array>

#include "planner/domain/problem.h"

namespace assay::check {

// The play of a mated part along one lateral axis of its hole, metres.
struct Play {
  geometry::Vector3 axis;  // unit, frame of the fixed part
  double nominal = 0;      // twice the clearance
  double measured = 0;     // in the engine

  double RelativeDifference() const;  // of measured from nominal
};

// `assay check` fails beyond this relative difference.
inline constexpr double kPlayTolerance = 0.05;

// Measures in the engine what clearance a mating really has there, along the axes x and y of the
// fixed part's first mating feature: the held part is put at its mated pose, without weight, the
// fixed part is held fast, and the held part is pushed each way until it stops. The push goes
// through the middle of the engaged length, so that the part does not tilt.
std::array<Play, 2> EffectiveClearance(const domain::Problem& problem, domain::MatingId mating);

}  // namespace assay::check
