#pragma once

#include <string>
#include <vector>

#include "planner/plan/data/plan.h"
#include "sim/execution/trace/trace.h"

namespace assay::check {

// One component of an error set, and its true value.
struct ObservedError {
  std::string name;  // "x of block"
  domain::Dimension dimension = domain::Dimension::kLength;
  Interval predicted;
  double observed = 0;
};

// Returns the components of an error set with their true values at `snapshot`. The set must be one
// that is claimed to hold at this snapshot.
std::vector<ObservedError> ObservedErrors(const domain::Problem& problem,
                                          const plan::Action& action, const plan::ErrorSet& set,
                                          const execution::Snapshot& snapshot);

// Returns how the action holds its part. The action must not be a look, which holds none.
const plan::Hold& HoldOf(const plan::Action& action);

// Returns the angle, in radians, by which a nearly upright rotation turns about the world's
// vertical.
double YawOf(const geometry::Matrix3& rotation);

}  // namespace assay::check
