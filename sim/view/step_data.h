#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"
#include "sim/check/certificate_claims/claim.h"
#include "sim/execution/trace/trace.h"

namespace assay::view {

// A plan, its execution, and the verdicts on its certificates; without verdicts if nothing measured
// what the engine can resolve.
struct Executed {
  const domain::Problem& problem;
  const plan::Plan& plan;
  const execution::Trace& trace;
  const std::vector<check::Claim>& claims;
  std::string plan_file;  // for errors
};

// Returns the steps in the order of execution, each with its certificate, its times and its
// verdicts (README.md, "Data").
nlohmann::ordered_json StepsOf(const Executed& executed);

}  // namespace assay::view
