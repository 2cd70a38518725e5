#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "planner/budget/budget.h"
#include "sim/report/charts/front_chart.h"

namespace assay::cli {

std::string Text(const budget::Budget& budget);

// sim/cli/verbs/budget.schema.json describes the result.
nlohmann::ordered_json ToJson(const budget::Budget& budget);

// Returns the fronts as they are drawn, in the units in which amounts are shown.
report::FrontPicture FrontPictureOf(const budget::Budget& budget);

}  // namespace assay::cli
