#pragma once

#include <nlohmann/json_fwd.hpp>

#include "planner/base/input_files/document.h"
#include "planner/plan/data/strategy.h"

namespace assay::plan {

// Returns a strategy as plan.json holds it (plan.schema.json). Numbers read back as exactly the
// same doubles.
nlohmann::ordered_json ToJson(const Strategy& strategy);

// Reads a strategy. Throws InputError with the place of the error: unknown contacts, normals that
// are not of unit length, or negative half widths.
Strategy ReadStrategy(const Value& value);

}  // namespace assay::plan
