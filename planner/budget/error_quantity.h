#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "planner/base/interval.h"
#include "planner/domain/problem/problem.h"
#include "planner/domain/units/units.h"

namespace assay::budget {

// A bound on errors that could be made smaller, by a better device or by closer tolerances: of one
// coordinate of a part, of the hand or of a sensor, a tolerance, or the velocity error of the arm.
struct ErrorQuantity {
  std::string name;  // "peg.x", "hand.theta", "overhead-camera.z", "clearance"
  domain::Dimension dimension = domain::Dimension::kRatio;
  Interval bounds;  // as declared: metres, radians or a ratio

  double declared() const { return std::max(std::abs(bounds.low), std::abs(bounds.high)); }
};

// Returns the quantities of a problem that are neither 0 nor unbounded, in a fixed order. Of
// sensors, those count which the problem may use.
std::vector<ErrorQuantity> ErrorQuantitiesOf(const domain::Problem& problem);

// Returns the problem with these bounds of all quantities, in the order of ErrorQuantitiesOf. A
// tolerance that would not be less than its value is a little less.
domain::Problem WithBounds(const domain::Problem& problem, const std::vector<Interval>& bounds);
// Returns the problem with each quantity times its multiple, 0 or more, in the same
// order.
domain::Problem WithErrorsTimes(const domain::Problem& problem,
                                const std::vector<double>& multiples);
// Returns the problem with all quantities times the same multiple.
domain::Problem WithErrorsTimes(const domain::Problem& problem, double multiple);

}  // namespace assay::budget
