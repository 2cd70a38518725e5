#pragma once

#include <functional>

#include "planner/plan/data/plan.h"
#include "sim/exec/execution/trace.h"
#include "sim/noise/noise.h"
#include "sim/scene/scene.h"
#include "sim/sense/pose_sensor.h"

namespace assay::exec {

// Sees an execution as it goes, with the simulation: to take pictures of what no trace keeps. It
// changes nothing.
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void SeeTimestep(const mujoco::Data& data) = 0;  // after each of them
  virtual void SeeMilestone(const Milestone& milestone, const mujoco::Data& data) = 0;
  virtual void SeeStepEnd(const StepEnd& end, const mujoco::Data& data) = 0;
};

struct ExecutorOptions {
  double sample_rate = 50;       // moments of the trace's series per simulated second; 0: none
  double free_timestep = 0.002;  // seconds, while the empty hand touches nothing
  double force_limit = 300;      // newtons at the wrist, then the arm stops
  noise::Noise noise = {};       // what is wrong with the world, the hand and the sensors
  bool recovers = true;          // from errors that verifications signal; false: it ends there
  plan::StepId last = plan::StepId::None();  // the execution ends with this step; None: the last
  // Looks at the parts; null: sensors err as the noise says.
  sense::PoseSensor* sensor = nullptr;
  // Called after each timestep, to break the execution off by an exception.
  std::function<void(const mujoco::Data&)> on_timestep = {};
  Observer* observer = nullptr;  // null: nobody looks on
};

}  // namespace assay::exec
