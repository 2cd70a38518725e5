#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "planner/plan/data/plan.h"
#include "sim/execution/trace/trace.h"
#include "sim/view/executed.h"
#include "sim/view/way.h"

namespace assay::view {

// Returns the times of the steps that were begun, in the order of execution: "from", "to", and
// whether the step "ended".
nlohmann::ordered_json TimesOf(const plan::Plan& plan, const execution::Trace& trace);

// Returns the steps in the order of execution, each with its certificate, its times and its
// verdicts (page/data.md).
nlohmann::ordered_json StepsOf(const Executed& executed);
// Returns the actions of a way in the same form. Actions that are no steps of the plan have no
// certificates.
nlohmann::ordered_json StepsOf(const Executed& executed, const std::vector<WalkedAction>& walked);

}  // namespace assay::view
