#pragma once

#include <nlohmann/json_fwd.hpp>

#include "planner/base/document/document.h"
#include "planner/plan/data/strategy.h"

namespace assay::plan {

// A strategy as plan.json holds it (plan.schema.json). Numbers read back as the very same doubles.
nlohmann::ordered_json ToJson(const Strategy& strategy);

// Throws InputError with the place for what does not fit: contacts that there are not, normals that
// are not of unit length, half widths below 0.
Strategy ReadStrategy(const Value& value);

}  // namespace assay::plan
