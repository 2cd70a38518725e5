#pragma once

#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/domain/units/units.h"

namespace assay::budget {

// A bound on errors that could be made smaller, by a better device or by closer tolerances: of one
// coordinate of a part, of the hand or of a sensor, a tolerance, or the velocity error of the arm.
struct ErrorQuantity {
  std::string name;  // "peg.x", "hand.theta", "overhead-camera.z", "clearance"
  domain::Dimension dimension = domain::Dimension::kRatio;
  double declared = 0;  // the greatest error on either side; metres, radians or a ratio
};

// Returns the quantities of a problem that are neither 0 nor unbounded, in a fixed order. Of
// sensors, those count which the problem may use.
std::vector<ErrorQuantity> ErrorQuantitiesOf(const domain::Problem& problem);

// Returns the problem with each quantity times its multiple, 0 or more, in the order of
// ErrorQuantitiesOf. A tolerance that would not be less than its value is a little less.
domain::Problem WithErrorsTimes(const domain::Problem& problem,
                                const std::vector<double>& multiples);
// Returns the problem with all quantities times the same multiple.
domain::Problem WithErrorsTimes(const domain::Problem& problem, double multiple);

}  // namespace assay::budget
