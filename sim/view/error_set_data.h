#pragma once

#include <nlohmann/json_fwd.hpp>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"
#include "sim/execution/trace/trace.h"
#include "sim/view/way.h"

namespace assay::view {

// Returns the predicted error sets of all steps that were begun, with the times at which the page
// shows them (page/data.md). Each has the extreme poses of its part in the frame of the
// part's believed pose.
nlohmann::ordered_json ErrorSetsOf(const plan::Plan& plan, const execution::Trace& trace);

// Returns the regions of actions in the same form. Their extremes are in the world frame ("fixed").
nlohmann::ordered_json RegionsOf(const std::vector<WalkedAction>& actions);

}  // namespace assay::view
