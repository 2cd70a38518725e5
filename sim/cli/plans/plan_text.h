#pragma once

#include <string>

#include "planner/domain/problem/problem.h"
#include "planner/plan/check/checker.h"
#include "planner/plan/data/plan.h"

namespace assay::cli {

// For people.

// "putdown(block, BG3, BP5)": the action with its arguments, grasp and position.
std::string Text(const domain::Problem& problem, const plan::Action& action);

// The steps in the order of execution, each with its place in the order of insertion and, if the
// plan has certificates, how much of it is proved.
std::string PlanTable(const domain::Problem& problem, const plan::Plan& plan);

// The table and what was done about uncertainty, or why there is no plan.
std::string Text(const domain::Problem& problem, const plan::PlanResult& result);

// The flaws, one a line, or how much was checked.
std::string Text(const plan::Plan& plan, const plan::CheckReport& report);

}  // namespace assay::cli
