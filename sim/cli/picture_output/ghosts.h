#pragma once

#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"
#include "sim/execution/trace/trace.h"
#include "sim/render/ghost.h"

namespace assay::cli {

// Returns what the step's certificate predicts for the step's end: each part at the extremes of its
// error set, relative to the believed poses in `snapshot`. Empty if the step has no certificate.
std::vector<render::Ghost> GhostsAfter(const domain::Problem& problem,
                                       const plan::PlannedStep& step,
                                       const execution::Snapshot& snapshot);

}  // namespace assay::cli
