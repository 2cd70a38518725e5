#include "planner/budget/greatest_multiple.h"

#include "planner/numeric/threshold.h"

namespace assay::budget {

GreatestMultiple FindGreatestMultiple(const ObstacleAt& obstacle_at) {
  constexpr double kPrecision = 0.005;
  constexpr double kStep = 1.01;
  const auto fails = [&](double multiple) { return obstacle_at(multiple).has_value(); };
  const Threshold threshold = FindThreshold(fails, 1, kMostMultiple, kPrecision);
  GreatestMultiple greatest = {.proved = threshold.holds};
  if (!threshold.fails) return greatest;
  if (greatest.proved == 0) {
    greatest.unproved = threshold.fails;
    greatest.obstacle = obstacle_at(*greatest.unproved);
    return greatest;
  }
  while (greatest.proved < kMostMultiple) {
    greatest.unproved = kStep * greatest.proved;
    greatest.obstacle = obstacle_at(*greatest.unproved);
    if (greatest.obstacle) return greatest;
    greatest.proved = *greatest.unproved;
  }
  return {.proved = greatest.proved};
}

}  // namespace assay::budget
