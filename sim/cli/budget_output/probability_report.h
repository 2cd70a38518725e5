#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "planner/plan/data/plan.h"
#include "planner/probability/failure_probability.h"

namespace assay::cli {

std::string Text(const probability::FailureProbabilities& failures, const plan::Plan& plan);

// sim/cli/verbs/budget.schema.json describes the result.
nlohmann::ordered_json ToJson(const probability::FailureProbabilities& failures,
                              const plan::Plan& plan);

}  // namespace assay::cli
