#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"
#include "sim/check/trial_verdicts/trial.h"

namespace assay::cli {

// Returns a text for people about one trial: a table of the steps, and the goals' predicates. A row
// has the step's duration, how far the handled part truly was from where it was believed to be, and
// the gripper's opening.
std::string ForPeople(const domain::Problem& problem, const plan::Plan& plan,
                      const check::Trial& trial);

// Returns the trial for programs, in SI units.
nlohmann::ordered_json ToJson(const domain::Problem& problem, const plan::Plan& plan,
                              const check::Trial& trial);

}  // namespace assay::cli
