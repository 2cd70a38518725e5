#pragma once

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"
#include "sim/check/trial/verdict.h"
#include "sim/cli/pictures/film.h"
#include "sim/execution/trace/trace.h"
#include "sim/scene/scene.h"

namespace assay::cli {

// A plan that is executed repeatedly in one scene.
struct Experiment {
  const domain::Problem& problem;
  const plan::Plan& plan;
  const scene::Scene& scene;
};

// One execution of a plan and its results.
struct Trial {
  int number = 0;  // from 1
  execution::Trace trace;
  check::Verdict verdict;
};

// Executes the plan once. `film` takes pictures, unless it is null. Throws BrokenOff as soon as an
// interruption is requested (interruption.h).
Trial RunTrial(const Experiment& experiment, int number, Film* film);

}  // namespace assay::cli
