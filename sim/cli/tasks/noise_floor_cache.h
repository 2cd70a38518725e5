#pragma once

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"
#include "sim/check/noise_floor/noise_floor.h"
#include "sim/check/trial_verdicts/trial.h"
#include "sim/scene/mjcf.h"

namespace assay::cli {

// Returns the noise floor of the plan (check::MeasureNoiseFloor). It is measured only once. The
// user's cache folder (assay/noise-floor in XDG_CACHE_HOME, or in .cache of HOME) keeps the noise
// floor under a hash of everything that determines it: this program, the engine, the origin of the
// problem, the plan, and the scene. If there is no cache folder, if it cannot be written, or if the
// problem has no origin, the floor is measured each time.
check::NoiseFloor KeptNoiseFloor(const domain::Problem& problem, const plan::Plan& plan,
                                 const scene::SceneOptions& scene);

// Gives the experiment the noise floor of its plan. Returns false, and leaves the noise floor
// empty, if a stop was requested before it is known (planner/base/stop.h).
bool TakeNoiseFloor(check::Experiment& experiment);

}  // namespace assay::cli
