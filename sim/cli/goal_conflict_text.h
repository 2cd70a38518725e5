#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "planner/contingent/goal_conflict.h"

namespace assay::cli {

// Why a task of contingent planning has no plan: the parts of its goal that no plan reaches
// together, one on each line.
std::string Text(const contingent::GroundTask& task, const contingent::GoalConflict& conflict);

// {"goal": [...], "minimal"}
nlohmann::ordered_json ToJson(const contingent::GroundTask& task,
                              const contingent::GoalConflict& conflict);

}  // namespace assay::cli
