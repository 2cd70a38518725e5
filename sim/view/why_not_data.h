#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/reason.h"
#include "sim/scene/scene.h"

namespace assay::view {

// Why there is no plan: reasons of one kind.
struct Reasons {
  std::string title;  // "These conditions cannot hold together"
  std::vector<plan::Reason> reasons;
};

// Returns the reasons as the page shows them (page/data.md): with the bodies that are drawn
// where the reason's situation has them.
nlohmann::ordered_json WhyNotOf(const std::vector<Reasons>& why_not, const domain::Problem& problem,
                                const scene::Scene& scene);

}  // namespace assay::view
