#pragma once

#include <functional>
#include <optional>

#include "planner/budget/obstacle.h"

namespace assay::budget {

// The greatest multiple of some errors for which everything is proved.
struct GreatestMultiple {
  double proved = 0;  // 0: not even without these errors, or below 1/64
  // 1.01 times `proved`, with which not everything is proved. Missing if everything is proved with
  // kMostMultiple.
  std::optional<double> unproved = {};
  std::optional<Obstacle> obstacle = {};  // with the multiple `unproved`
};

inline constexpr double kMostMultiple = 64;

// Returns the obstacle with these multiples of the errors. None: everything is proved.
using ObstacleAt = std::function<std::optional<Obstacle>(double multiple)>;

// Searches by doubling and halving. Greater errors need not be harder to prove for a planner that
// plans anew, so the answer is a multiple at which proofs end, and not always the last one.
GreatestMultiple FindGreatestMultiple(const ObstacleAt& obstacle_at);

}  // namespace assay::budget
