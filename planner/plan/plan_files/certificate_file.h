#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "planner/base/input_files/document.h"
#include "planner/domain/problem/problem.h"
#include "planner/plan/certificates/certificate.h"
#include "planner/plan/certificates/condition_table.h"

namespace assay::plan {

// Returns a certificate as plan.json holds it (plan.schema.json). Numbers read back as exactly the
// same doubles; infinite ones are the strings "inf" and "-inf". `step_names` is indexed by StepId.
nlohmann::ordered_json ToJson(const Certificate& certificate, const domain::Problem& problem,
                              const std::vector<std::string>& step_names);

// Reads a certificate whose preconditions are of the given kinds. Throws InputError with the place
// of the error: unknown parts, steps, conditions and errors, or reversed ranges.
Certificate ReadCertificate(const Value& value, const domain::Problem& problem,
                            const std::vector<std::string>& step_names,
                            ConditionKinds kinds = KnownConditions());

}  // namespace assay::plan
