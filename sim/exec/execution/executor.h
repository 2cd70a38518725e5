#pragma once

#include <vector>

#include "planner/plan/data/plan.h"
#include "sim/exec/execution/executor_options.h"
#include "sim/exec/execution/trace.h"
#include "sim/noise/noise.h"
#include "sim/scene/scene.h"

namespace assay::exec {

// The scene's options of a world with this noise.
scene::SceneOptions TrueScene(scene::SceneOptions options, const noise::Noise& noise);

// Where the parts rest without errors: places and yaws as the problem says, heights and tilts as
// they come to rest in the engine. Otherwise a part that leans would slide by hundredths of a
// millimetre at first, and its error would not be the one that was drawn.
std::vector<Pose> RestingPoses(const domain::Problem& problem, const scene::Scene& scene);

// A simulation at the start of a trial: the parts where they truly are, on tables as high as they
// truly are.
mujoco::Data StartOf(const domain::Problem& problem, const scene::Scene& scene,
                     const noise::Noise& noise);

// Executes a plan, asking the planner nothing. `data` is a simulation of `scene` at the start of
// the trial, the parts wherever they truly are, and afterwards at its end. The problem tells where
// they are believed to be.
Trace Execute(const domain::Problem& problem, const plan::Plan& plan, const scene::Scene& scene,
              mujoco::Data& data, const ExecutorOptions& options);

}  // namespace assay::exec
