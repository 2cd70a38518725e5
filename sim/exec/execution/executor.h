#pragma once

#include <functional>
#include <vector>

#include "planner/plan/data/plan.h"
#include "sim/exec/execution/trace.h"
#include "sim/noise/noise.h"
#include "sim/scene/scene.h"
#include "sim/sense/pose_sensor.h"

namespace assay::exec {

// Observes an execution together with the simulation, for pictures of what no trace keeps. It must
// change nothing.
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void SeeTimestep(const mujoco::Data& data) = 0;  // called after each timestep
  virtual void SeeMilestone(const Milestone& milestone, const mujoco::Data& data) = 0;
  virtual void SeeStepEnd(const StepEnd& end, const mujoco::Data& data) = 0;
};

struct ExecutorOptions {
  double sample_rate = 50;  // moments per simulated second in the trace's series; 0 for no series
  double free_timestep = 0.002;  // seconds, while the empty hand touches nothing
  double force_limit = 300;      // newtons at the wrist; above it the arm stops
  noise::Noise noise = {};       // errors of the world, the hand and the sensors
  bool recovers = true;  // whether it recovers from errors that verifications signal, or ends there
  // The execution ends with this step; None: with the plan's last.
  plan::StepId last = plan::StepId::None();
  // Measures the parts' poses; if null, sensors err as the noise says.
  sense::PoseSensor* sensor = nullptr;
  // Called after each timestep. It can stop the execution by an exception.
  std::function<void(const mujoco::Data&)> on_timestep = {};
  Observer* observer = nullptr;  // may be null
};

// Returns the scene's options with the errors that the noise has for the scene.
scene::SceneOptions TrueScene(scene::SceneOptions options, const noise::Noise& noise);

// Returns the poses in which the parts rest without errors: places and yaws as the problem has
// them, heights and tilts as they come to rest in the engine. Otherwise a part that leans would
// slide by hundredths of a millimetre at first, and its error would not be the drawn one.
std::vector<Pose> RestingPoses(const domain::Problem& problem, const scene::Scene& scene);

// Returns a simulation at the start of a trial, with the parts at their true poses and the tables
// at their true heights.
mujoco::Data StartOf(const domain::Problem& problem, const scene::Scene& scene,
                     const noise::Noise& noise);

// Executes a plan without asking the planner. `data` must be a simulation of `scene` at the start
// of the trial, with the parts at their true poses; afterwards it is at the end of the trial. The
// problem holds the believed poses of the parts.
Trace Execute(const domain::Problem& problem, const plan::Plan& plan, const scene::Scene& scene,
              mujoco::Data& data, const ExecutorOptions& options);

}  // namespace assay::exec
