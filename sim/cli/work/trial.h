#pragma once

#include <cstdint>
#include <functional>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"
#include "sim/check/trial/verdict.h"
#include "sim/cli/pictures/film.h"
#include "sim/exec/execution/trace.h"
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
  exec::Trace trace;
  check::Verdict verdict;
};

// Executes the plan once. `film` takes pictures, unless it is null. Throws BrokenOff as soon as an
// interruption is requested (interruption.h).
Trial RunTrial(const Experiment& experiment, int number, Film* film);

// Calls `work` with the numbers 1 .. trials on `jobs` threads, with number 1 on the calling thread.
// No more numbers are handed out once an interruption is requested, or once `work` threw. The
// exception is thrown again at the end, except that BrokenOff ends only its thread.
void ForEachTrial(int trials, int jobs, const std::function<void(int number)>& work);

// The number of trials and how they are run.
struct TrialPlan {
  int trials = 1;
  int jobs = 1;          // threads
  Film* film = nullptr;  // takes pictures of the first trial, unless null
};

// Runs the trials on plan.jobs threads, the first trial on the calling thread. `done` gets each
// trial as it ends, in any order and from any thread. No result depends on this order. An
// interruption ends the trials early. Throws what a trial or `done` threw.
void RunTrials(const Experiment& experiment, const TrialPlan& plan,
               const std::function<void(Trial)>& done);

}  // namespace assay::cli
