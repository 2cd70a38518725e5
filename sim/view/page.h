#pragma once

#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"
#include "sim/check/certificate_claims/claim.h"
#include "sim/execution/trace/trace.h"
#include "sim/scene/scene.h"

namespace assay::view {

// What a page shows: an execution of a plan in a scene.
struct Subject {
  const domain::Problem& problem;
  const plan::Plan& plan;
  const scene::Scene& scene;
  const execution::Trace& trace;
  std::vector<check::Claim> claims = {};  // verdicts on the certificates; empty: there are none
  std::string source = {};                // what was viewed, for people: "trace out/trace-3.jsonl"
  std::string plan_file = {};             // for errors
};

// Returns the page as one HTML file, which fetches nothing. Equal subjects give equal bytes.
std::string Page(const Subject& subject);

}  // namespace assay::view
