#pragma once

#include <nlohmann/json_fwd.hpp>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"
#include "sim/scene/scene.h"

namespace assay::view {

// Adds to the steps of a page the ways of the arm that are not proved (page/data.md). The way home
// belongs to the last step of the plan.
void AddUnprovedWays(const domain::Problem& problem, const plan::Plan& plan,
                     const scene::Scene& scene, nlohmann::ordered_json& steps);

}  // namespace assay::view
