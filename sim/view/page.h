#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"
#include "sim/check/certificate_claims/claim.h"
#include "sim/execution/trace/trace.h"
#include "sim/scene/scene.h"
#include "sim/view/way.h"
#include "sim/view/why_not_data.h"

namespace assay::view {

// Another execution of the same plan, which is shown beside the first one.
struct Beside {
  std::string name;  // for people: "the plan without noise"
  const scene::Scene& scene;
  const execution::Trace& trace;
};

// What a page shows: an execution of a plan in a scene. Without a plan, `plan` has no steps, and
// the trace has one sample.
struct Subject {
  const domain::Problem& problem;
  const plan::Plan& plan;
  const scene::Scene& scene;
  const execution::Trace& trace;
  std::string outcome = {};               // of the execution: "succeeded"
  std::string reason = {};                // empty if it succeeded
  std::string summary = {};               // of the plan; empty: the page sums up its certificates
  std::vector<check::Claim> claims = {};  // verdicts on the certificates; empty: there are none
  std::optional<Beside> beside = {};
  // Set if the execution did not follow one plan. `plan` is then the plan of the execution's world,
  // or empty if this world has no plan.
  std::optional<Way> way = {};
  std::vector<Reasons> why_not = {};  // if there is no plan: the scene is then shown as it lies
  std::string source = {};            // what was viewed, for people: "trace out/trace-3.jsonl"
  std::string plan_file = {};         // for errors
};

// Returns the page as one HTML file, which fetches nothing. Equal subjects give equal bytes.
std::string Page(const Subject& subject);

}  // namespace assay::view
