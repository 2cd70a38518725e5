#pragma once

#include <nlohmann/json_fwd.hpp>

#include "planner/plan/data/plan.h"
#include "sim/view/executed.h"

namespace assay::view {

// Returns the preconditions of a step as the page shows them (page/data.md): a record for each
// kind of condition, with its tightest claim, what that claim's errors cost, and how many claims
// are not proved. The least margin comes first.
nlohmann::ordered_json PreconditionsOf(const Executed& executed, plan::StepId step);

}  // namespace assay::view
