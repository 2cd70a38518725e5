#pragma once

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"
#include "sim/check/noise_floor/noise_floor.h"
#include "sim/scene/mjcf.h"

namespace assay::cli {

// Returns the noise floor of the plan (check::MeasureNoiseFloor). It is measured only once. The
// user's cache folder (assay/noise-floor in XDG_CACHE_HOME, or in .cache of HOME) keeps the noise
// floor under a hash of everything that determines it: this program, the engine, the origin of the
// problem, the plan, and the scene. If there is no cache folder, if it cannot be written, or if the
// problem has no origin, the floor is measured each time.
check::NoiseFloor KeptNoiseFloor(const domain::Problem& problem, const plan::Plan& plan,
                                 const scene::SceneOptions& scene);

}  // namespace assay::cli
