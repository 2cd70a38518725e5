#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "planner/plan/data/plan.h"

namespace assay::view {

// Returns the preconditions of a step as the page shows them (page/data.md): a record for each
// kind of condition, with its tightest claim, what that claim's errors cost, and how many claims
// are not proved. The least margin comes first. `file` names the plan in errors.
nlohmann::ordered_json PreconditionsOf(const plan::PlannedStep& step, const std::string& file);

}  // namespace assay::view
