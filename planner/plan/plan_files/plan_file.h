#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "planner/base/input_files/document.h"
#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"

namespace assay::plan {

// Returns the plan as plan.json, "assay-plan/2" (its schema is plan.schema.json). The same result
// gives the same bytes: there are no times, and numbers read back as exactly the same doubles.
// `scenario` is the path of the scenario file as the user gave it.
nlohmann::ordered_json ToJson(const PlanResult& result, const domain::Problem& problem,
                              const std::string& scenario);

// Returns the scenario's path in a plan file. Throws InputError if the document is no plan file.
std::string ScenarioOf(const Document& plan_file);

// Reads a plan back. Throws InputError with the place of anything that does not fit the format or
// the problem: unknown parts, matings, a cyclic ordering, or execution indices that are no
// permutation.
PlanResult ReadPlan(const Document& plan_file, const domain::Problem& problem);

}  // namespace assay::plan
