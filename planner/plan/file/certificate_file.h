#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "planner/base/document/document.h"
#include "planner/domain/problem/problem.h"
#include "planner/plan/data/certificate.h"

namespace assay::plan {

// A certificate as plan.json holds it (plan.schema.json). Numbers read back as the very same
// doubles; infinite ones are the strings "inf" and "-inf". `step_names`: by StepId.
nlohmann::ordered_json ToJson(const Certificate& certificate, const domain::Problem& problem,
                              const std::vector<std::string>& step_names);

// Throws InputError with the place for what does not fit: unknown parts and steps, ranges that go
// down.
Certificate ReadCertificate(const Value& value, const domain::Problem& problem,
                            const std::vector<std::string>& step_names);

}  // namespace assay::plan
