#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "planner/contingent/search/contingent_planner.h"
#include "planner/contingent/search/goal_conflict.h"

namespace assay::cli {

// Returns why a task of contingent planning has no plan: the parts of its goal that no plan can
// achieve together, one on each line.
std::string Text(const contingent::GroundTask& task, const contingent::GoalConflict& conflict);

// Returns a message that no plan was found, which does not prove that there is none. It states why
// the planner cannot tell, or else the budget in knowledge states.
std::string NotFoundText(const contingent::ContingentPlan& plan, std::int64_t budget);

// Returns {"goal": [...], "minimal"}.
nlohmann::ordered_json ToJson(const contingent::GroundTask& task,
                              const contingent::GoalConflict& conflict);

}  // namespace assay::cli
