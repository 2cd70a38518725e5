#pragma once

#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"
#include "sim/check/certificate_claims/claim.h"
#include "sim/execution/trace/trace.h"

namespace assay::view {

// A plan, its execution, and the verdicts on its certificates. There are no verdicts if the noise
// floor was not measured.
struct Executed {
  const domain::Problem& problem;
  const plan::Plan& plan;
  const execution::Trace& trace;
  const std::vector<check::Claim>& claims;
  std::string plan_file;  // for errors
};

}  // namespace assay::view
