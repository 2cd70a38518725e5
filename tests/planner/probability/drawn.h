#pragma once

#include <random>

#include "planner/probability/error_distribution.h"

namespace assay::probability {

// Draws an error. A normal error that is cut off is drawn again until it is within its range.
inline double Drawn(const ErrorDistribution& distribution, std::mt19937_64& random) {
  const auto& [low, high] = distribution.range;
  if (distribution.shape == ErrorDistribution::Shape::kUniform)
    return std::uniform_real_distribution<>(low, high)(random);
  std::normal_distribution<> normal(0, distribution.deviation);
  while (true) {
    const double value = normal(random);
    if (value >= low && value <= high) return value;
  }
}

}  // namespace assay::probability
