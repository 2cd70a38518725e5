#pragma once

#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"

namespace assay::check {

// The play of a mated part between two walls of its hole that face each other. Lengths are in
// metres.
struct Play {
  geometry::Vector3 axis;  // unit vector across the walls, in the fixed part's frame
  double nominal = 0;      // between walls and shaft, as the parts are drawn
  double measured = 0;     // between walls and shaft, in the engine

  double RelativeDifference() const;  // of `measured` from `nominal`
};

// `assay check` fails beyond this relative difference between measured and nominal play.
inline constexpr double kPlayTolerance = 0.05;

// Measures in the engine the true clearance of a mating. Returns one Play for each pair of walls of
// its holes that face each other, whichever part has the hole; empty if no shaft of the mating is
// in a hole. The held part is put at its mated pose without weight, the fixed part is held fast,
// and the held part is pushed each way until it stops. The push goes through the middle of the
// engaged length, so that the part does not tilt.
std::vector<Play> EffectiveClearance(const domain::Problem& problem, domain::MatingId mating);

// Measures the same in a model of the two parts alone (scene::ExportedPair) with the unmodified
// engine. Other programs that load this model have this play. If the hole has many pairs of walls,
// four of them are measured, whose directions are spread evenly.
std::vector<Play> ExportedClearance(const domain::Problem& problem, domain::MatingId mating,
                                    const std::string& mjcf);

}  // namespace assay::check
