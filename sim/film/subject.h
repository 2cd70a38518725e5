#pragma once

#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"
#include "sim/execution/trace/trace.h"
#include "sim/scene/scene.h"

namespace assay::film {

// What a film shows: an execution of a plan in a scene. The trace must have samples.
struct Subject {
  const domain::Problem& problem;
  const plan::Plan& plan;
  const scene::Scene& scene;
  const execution::Trace& trace;
};

// Returns the parts that the plan's actions are about, or all parts if the plan has no steps.
std::vector<domain::PartId> WorkedParts(const domain::Problem& problem, const plan::Plan& plan);

}  // namespace assay::film
