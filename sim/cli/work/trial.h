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

// A plan that is to be executed, again and again, in one scene.
struct Experiment {
  const domain::Problem& problem;
  const plan::Plan& plan;
  const scene::Scene& scene;
};

// One execution of a plan, with what came of it.
struct Trial {
  int number = 0;  // from 1
  exec::Trace trace;
  check::Verdict verdict;
};

// `film` takes pictures, unless it is null. Throws BrokenOff as soon as an
// interruption is requested (interruption.h).
Trial RunTrial(const Experiment& experiment, int number, Film* film);

// Calls `work` with the numbers 1 .. trials on that many threads; number 1 on this one. No more
// numbers are handed out once an interruption is requested, or once `work` threw, what is thrown on
// at the end. BrokenOff ends nothing but its thread.
void ForEachTrial(int trials, int jobs, const std::function<void(int number)>& work);

struct TrialPlan {
  int trials = 1;
  int jobs = 1;          // threads
  Film* film = nullptr;  // of the first trial
};

// Runs the trials on that many threads; the first one on this thread. `done` gets each as it ends,
// in any order and from any thread: what the trials come to does not depend on it. An interruption
// ends them early. Throws what a trial or `done` threw.
void RunTrials(const Experiment& experiment, const TrialPlan& plan,
               const std::function<void(Trial)>& done);

}  // namespace assay::cli
