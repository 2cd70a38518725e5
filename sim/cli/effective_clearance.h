#pragma once

#include <vector>

#include "planner/domain/problem.h"
#include "sim/scene/scene.h"

namespace assay::cli {

// How far the held part of a mating can really be moved in the engine before it touches the hole's
// side, from the mated pose drawn back by kDrawnBack: along x and y of the hole's frame, both ways.
struct EffectiveClearance {
  domain::MatingId mating;
  double nominal = 0;          // metres
  std::vector<double> gaps;    // metres, +x, -x, +y, -y; the search goes to 4 times the nominal
  double worst_deviation = 0;  // greatest |gap - nominal| / nominal
};

inline constexpr double kDrawnBack = 0.001;          // metres
inline constexpr double kClearanceDeviation = 0.05;  // more than this is a fault of the model

// For each mating of a problem in which something goes into a hole of the other part.
std::vector<EffectiveClearance> MeasureClearances(const domain::Problem& problem,
                                                  const scene::Scene& scene);

}  // namespace assay::cli
