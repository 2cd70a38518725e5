#pragma once

#include <nlohmann/json_fwd.hpp>

#include "planner/base/document/document.h"
#include "planner/plan/data/plan.h"

namespace assay::plan {

// Paths as plan.json holds them; numbers read back as the very same doubles.
nlohmann::ordered_json ToJson(const Travel& travel);

// Throws InputError with the place: less than two postures, a posture that is not six numbers, a
// clearance below 0.
Travel ReadTravel(const Value& value);

}  // namespace assay::plan
