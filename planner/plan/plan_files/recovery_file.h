#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "planner/base/input_files/document.h"
#include "planner/plan/data/plan.h"

namespace assay::plan {

// Return verifications and recoveries as plan.json holds them (plan.schema.json). `step_names` is
// indexed by StepId.
nlohmann::ordered_json ToJson(const Verification& verification,
                              const std::vector<std::string>& step_names);
nlohmann::ordered_json ToJson(const Recovery& recovery, const std::vector<std::string>& step_names);

// Read verifications and recoveries. They throw InputError with the place of the error.
Verification ReadVerification(const Value& value, const std::vector<std::string>& step_names);
Recovery ReadRecovery(const Value& value, const std::vector<std::string>& step_names);

}  // namespace assay::plan
