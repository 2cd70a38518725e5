#pragma once

#include <vector>

#include "planner/domain/problem/problem.h"

namespace assay::check {

// The play of a mated part across walls of its holes that face each other, metres.
struct Play {
  geometry::Vector3 axis;  // unit, frame of the fixed part
  double nominal = 0;      // between walls and shafts, as the parts are drawn
  double measured = 0;     // in the engine

  double RelativeDifference() const;  // of measured from nominal
};

// `assay check` fails beyond this relative difference.
inline constexpr double kPlayTolerance = 0.05;

// Measures in the engine what clearance a mating really has, across each pair of walls of its holes
// that face each other, whichever part has the hole: the held part is put at its mated pose,
// without weight, the fixed part is held fast, and the held part is pushed each way until it stops.
// The push goes through the middle of the engaged length, so that the part does not tilt. Empty: no
// shaft of the mating is in a hole.
std::vector<Play> EffectiveClearance(const domain::Problem& problem, domain::MatingId mating);

}  // namespace assay::check
