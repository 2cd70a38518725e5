#pragma once

#include <string>

#include "planner/domain/problem/problem.h"
#include "planner/plan/checker/checker.h"
#include "planner/plan/data/plan.h"

namespace assay::cli {

// These functions return text for people.

// Returns a table of the steps in the order of execution. Each row has the step's place in the
// order of insertion and, if the plan has certificates, how much of the step is proved.
std::string PlanTable(const domain::Problem& problem, const plan::Plan& plan);

// Returns the table and what was done about uncertainty, or the reason why there is no plan.
std::string Text(const domain::Problem& problem, const plan::PlanResult& result);

// Returns the text for a plan, or for an answer without a plan, in which flaws were found. The text
// has the table, and leaves out the claims.
std::string TextOfFlawed(const domain::Problem& problem, const plan::PlanResult& result);

// Returns the flaws, one on each line, or how much was checked if there are none.
std::string Text(const plan::Plan& plan, const plan::CheckReport& report);

}  // namespace assay::cli
