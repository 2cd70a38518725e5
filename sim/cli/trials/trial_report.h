#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"
#include "sim/cli/work/trial.h"

namespace assay::cli {

// One trial for people: a table of the steps with their duration, how far the handled part truly
// was from where it was believed to be, and the opening; then the goals' predicates.
std::string ForPeople(const domain::Problem& problem, const plan::Plan& plan, const Trial& trial);

// The same for programs, in SI.
nlohmann::ordered_json ToJson(const domain::Problem& problem, const plan::Plan& plan,
                              const Trial& trial);

}  // namespace assay::cli
