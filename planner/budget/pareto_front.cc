#include "planner/budget/pareto_front.h"

#include <cmath>

#include "planner/budget/greatest_multiple.h"

namespace assay::budget {
namespace {

using Direction = std::array<double, 2>;

// Returns directions whose greater coordinate is 1: each axis, and ratios of both coordinates from
// 1/32 to 32 in steps of the square root of 2.
std::vector<Direction> Directions() {
  constexpr int kSteps = 10;
  std::vector<Direction> directions = {{0, 1}};
  for (int step = -kSteps; step <= kSteps; ++step) {
    const double ratio = std::exp2(-0.5 * std::abs(step));
    directions.push_back(step < 0 ? Direction{ratio, 1} : Direction{1, ratio});
  }
  directions.push_back({1, 0});
  return directions;
}

std::array<double, 2> Times(double multiple, const Direction& direction) {
  return {multiple * direction[0], multiple * direction[1]};
}

FrontPoint PointIn(const Direction& direction, const ObstacleAtBoth& obstacle_at) {
  const GreatestMultiple greatest = FindGreatestMultiple([&](double multiple) {
    const auto [first, second] = Times(multiple, direction);
    return obstacle_at(first, second);
  });
  FrontPoint point = {Times(greatest.proved, direction), {}, greatest.obstacle};
  if (greatest.unproved) point.unproved = Times(*greatest.unproved, direction);
  return point;
}

}  // namespace

std::vector<FrontPoint> ParetoFront(const ObstacleAtBoth& obstacle_at) {
  std::vector<FrontPoint> front;
  for (const Direction& direction : Directions()) front.push_back(PointIn(direction, obstacle_at));
  return front;
}

}  // namespace assay::budget
