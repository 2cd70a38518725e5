#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "planner/budget/budget.h"
#include "planner/probability/failure_probability.h"
#include "sim/cli/tasks/planned_problem.h"

namespace assay::cli {

// The budget of a plan, and how likely it fails if its scenario has distributions.
struct BudgetedPlan {
  budget::Budget budget;
  std::optional<probability::FailureProbabilities> failures;
};

// Returns the budget of a plan that was found. The scenario's keys `prices`, `distributions` and
// `correlations` count. `front` names no errors, or two or three groups whose front is wanted.
// Throws UsageError if it names others, and InputError for errors in the scenario file.
BudgetedPlan BudgetOf(const PlannedProblem& planned, const std::vector<std::string>& front);

std::string Text(const BudgetedPlan& budgeted, const plan::Plan& plan);

// sim/cli/verbs/budget.schema.json describes the result, except for the time.
nlohmann::ordered_json ToJson(const BudgetedPlan& budgeted, const plan::Plan& plan);

}  // namespace assay::cli
