#pragma once

#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"
#include "sim/exec/execution/trace.h"
#include "sim/render/ghost.h"

namespace assay::cli {

// What the step's certificate says of its end: each part at the extremes of its predicted error
// set, as seen from what is believed at that moment. None if the step has no certificate.
std::vector<render::Ghost> GhostsAfter(const domain::Problem& problem,
                                       const plan::PlannedStep& step, const exec::Moment& moment);

}  // namespace assay::cli
