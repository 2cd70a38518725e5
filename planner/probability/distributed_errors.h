#pragma once

#include <map>
#include <string>
#include <vector>

#include "planner/base/input_files/document.h"
#include "planner/budget/error_quantity.h"
#include "planner/domain/units/units.h"
#include "planner/probability/error_distribution.h"

namespace assay::probability {

// Two normal errors of one draw that are not independent. The errors are not cut off.
struct Correlation {
  std::string first;
  std::string second;
  double coefficient = 0;  // between -1 and 1
};

// What a scenario says of the probabilities of its errors. Errors without a distribution may have
// any value within their bounds. Without a correlation, errors are independent of each other, and
// so are the draws of one error.
struct DistributedErrors {
  std::map<std::string, ErrorDistribution> distributions;  // by name of the error: "peg.x"
  std::vector<Correlation> correlations;
};

// Reads a scenario's key `distributions`, a map from names of errors to distributions:
//
//   {peg.xy: {normal: 0.02}, hand.theta: {normal: 0.01, within: 0.03}, block.x: uniform}
//
// A normal distribution has a standard deviation and the mean 0, and may be cut off at `within` on
// both sides. A uniform distribution has the declared bounds. Numbers are in the units of the file.
// Only errors of poses have distributions. Throws InputError.
std::map<std::string, ErrorDistribution> ReadDistributions(const Value& distributions,
                                                           const domain::Units& units,
                                                           const domain::Problem& problem);

// Reads a scenario's key `correlations`: a list of [ERROR, ERROR, COEFFICIENT]. Both errors belong
// to parts, or both to the hand, and have normal distributions that are not cut off. Throws
// InputError, also if no errors can have all these correlations at once.
std::vector<Correlation> ReadCorrelations(
    const Value& correlations, const std::map<std::string, ErrorDistribution>& distributions,
    const domain::Problem& problem);

}  // namespace assay::probability
