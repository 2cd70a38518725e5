#pragma once

#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/checker/world_state.h"

namespace assay::plan {

// Returns the goals of the problem that do not hold in the state, in words. A located goal holds if
// the corners that one of its stable poses puts lowest are the part's corners on the table.
std::vector<std::string> GoalsNotReached(const domain::Problem& problem, const WorldState& state);

}  // namespace assay::plan
