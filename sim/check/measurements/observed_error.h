#pragma once

#include <string>
#include <vector>

#include "planner/plan/data/plan.h"
#include "sim/execution/trace/trace.h"

namespace assay::check {

// What a small turn of a part does to the position of its origin.
struct Lever {
  double length = 0;  // distance of the origin from the part's body, metres
  double arm = 1;     // half the least extent of the body's box, metres
};
Lever LeverOf(const domain::PartModel& model);

// One component of an error set, and its true value.
struct ObservedError {
  std::string name;  // "x of block"
  domain::Dimension dimension = domain::Dimension::kLength;
  Interval predicted;
  double observed = 0;
  Lever lever = {};  // of the point whose position is observed; no length for a point of the hand
};

// Returns the components of an error set with their true values at `snapshot`. The set must be one
// that is claimed to hold at this snapshot.
std::vector<ObservedError> ObservedErrors(const domain::Problem& problem,
                                          const plan::Action& action, const plan::ErrorSet& set,
                                          const execution::Snapshot& snapshot);

}  // namespace assay::check
