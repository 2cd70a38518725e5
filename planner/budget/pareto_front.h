#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "planner/budget/obstacle.h"

namespace assay::budget {

// A point on the border of what is proved, as multiples of two groups of errors.
struct FrontPoint {
  std::array<double, 2> proved = {};
  // 1.01 times `proved`, with which not everything is proved. Missing if everything is proved up to
  // kMostMultiple.
  std::optional<std::array<double, 2>> unproved = {};
  std::optional<Obstacle> obstacle = {};  // with the multiples `unproved`
};

// Returns the obstacle with these multiples of the two groups. None: everything is proved.
using ObstacleAtBoth = std::function<std::optional<Obstacle>(double first, double second)>;

// Returns points of the Pareto front, from errors of the second group alone to errors of the first
// group alone. Each point is the greatest multiple in one direction, so each is shown from both
// sides. Everything is proved, too, with smaller errors than those of a point, because what is
// proved for some errors is proved for all smaller ones.
std::vector<FrontPoint> ParetoFront(const ObstacleAtBoth& obstacle_at);

}  // namespace assay::budget
