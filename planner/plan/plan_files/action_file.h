#pragma once

#include <nlohmann/json_fwd.hpp>

#include "planner/base/input_files/document.h"
#include "planner/domain/problem/problem.h"
#include "planner/plan/data/action.h"

namespace assay::plan {

// Return an action's arguments, and what the arguments stand for, as plan.json holds them
// (plan.schema.json). Numbers read back as exactly the same doubles.
nlohmann::ordered_json ArgumentsToJson(const Action& action, const domain::Problem& problem);
nlohmann::ordered_json ToJson(const Hold& hold);
nlohmann::ordered_json ToJson(const Place& place);

// Reads the action of a step. Its kind must be one of the problem's. Throws InputError with the
// place of the error: unknown kinds, parts, matings and sensors, or arguments that the kind does
// not have.
Action ReadAction(const Value& step, const domain::Problem& problem);

}  // namespace assay::plan
