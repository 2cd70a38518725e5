#pragma once

#include <vector>

#include "planner/plan/data/plan.h"
#include "sim/execution/robots/execution.h"
#include "sim/execution/trace/trace.h"
#include "sim/noise/noise.h"
#include "sim/scene/scene.h"

namespace assay::execution {

// Returns the scene's options with the errors that the noise has for the scene.
scene::SceneOptions TrueScene(scene::SceneOptions options, const noise::Noise& noise);

// Returns the poses in which the parts rest without errors. Places and yaws come from the problem;
// heights and tilts are what the parts settle to in the engine. With the problem's heights and
// tilts, a part that leans would first slide by hundredths of a millimetre, and its error would
// differ from the drawn error.
std::vector<Pose> RestingPoses(const domain::Problem& problem, const scene::Scene& scene);

// Puts the parts at their true poses at the start, and the tables under them at their true heights.
// `resting` are the poses without errors, by part.
void PlaceAtStart(const domain::Problem& problem, const scene::Scene& scene,
                  const std::vector<Pose>& resting, const noise::Noise& noise,
                  const std::vector<domain::PartId>& parts, mujoco::Data& data);

// Returns a simulation at the start of a trial, with the parts at their true poses and the tables
// at their true heights.
mujoco::Data StartOf(const domain::Problem& problem, const scene::Scene& scene,
                     const noise::Noise& noise);

// Keeps the arm at rest for more than half a second, and records how fast the parts move in the
// meantime.
Progress Rest(Execution& execution, RestRecord& rest);

// Executes a plan without asking the planner. `data` must be a simulation of `scene` at the start
// of the trial, with the parts at their true poses; afterwards it is at the end of the trial. The
// problem holds the believed poses of the parts.
Trace Execute(const domain::Problem& problem, const plan::Plan& plan, const scene::Scene& scene,
              mujoco::Data& data, const ExecutorOptions& options);

}  // namespace assay::execution
