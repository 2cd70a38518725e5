#pragma once

#include <vector>

#include "sim/execution/trace/trace.h"
#include "sim/execution/trial/finding.h"

namespace assay::execution {

// Judges all goals of a problem by the trace of an execution, whose last event is its end: each
// mating and each place, and whether the parts are released and at rest. This is the only rule of
// success for plans and for plan trees.
std::vector<Finding> GoalFindings(const domain::Problem& problem, const Trace& trace,
                                  const Limits& limits);

}  // namespace assay::execution
