#pragma once

#include <nlohmann/json_fwd.hpp>

#include "planner/base/input_files/document.h"
#include "planner/plan/data/plan.h"

namespace assay::plan {

// Returns a path as plan.json holds it. Numbers read back as exactly the same doubles.
nlohmann::ordered_json ToJson(const Travel& travel);

// Reads a path. Throws InputError with the place of the error: fewer than two postures, a posture
// that is not six numbers, or a negative clearance.
Travel ReadTravel(const Value& value);

}  // namespace assay::plan
