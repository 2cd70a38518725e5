#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"
#include "sim/execution/trace/trace.h"
#include "sim/scene/scene.h"

namespace assay::film {

// An action of an execution that did not follow one plan.
struct Walked {
  std::string action;         // for people: "look(peg, overhead-camera)"
  std::optional<double> end;  // simulated seconds; none if the action did not end
};

// What a film shows: an execution of a plan in a scene. The trace must have samples.
struct Subject {
  const domain::Problem& problem;
  const plan::Plan& plan;
  const scene::Scene& scene;
  const execution::Trace& trace;
  std::string end;  // how the execution ended, for people: "done"
  // The actions in the order of execution, if they are not the steps of the plan.
  std::optional<std::vector<Walked>> walked = {};
};

// Returns the parts that the plan's actions are about, or all parts if the plan has no steps.
std::vector<domain::PartId> WorkedParts(const domain::Problem& problem, const plan::Plan& plan);

}  // namespace assay::film
