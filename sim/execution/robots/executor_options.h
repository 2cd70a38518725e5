#pragma once

#include <functional>

#include "planner/plan/data/plan.h"
#include "sim/execution/trace/trace.h"
#include "sim/noise/noise.h"
#include "sim/scene/scene.h"
#include "sim/sense/pose_sensor.h"

namespace assay::execution {

// Observes an execution together with the simulation, for pictures of what no trace keeps. It must
// change nothing.
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void SeeStart(const mujoco::Data& data) = 0;
  virtual void SeeTimestep(const mujoco::Data& data) = 0;  // called after each timestep
  virtual void SeeMilestone(const Milestone& milestone, const mujoco::Data& data) = 0;
  virtual void SeeStepEnd(const StepEnd& end, const mujoco::Data& data) = 0;
};

struct ExecutorOptions {
  double sample_rate = 50;  // samples per simulated second in the trace's series; 0 for no series
  // The shortest time between two states of motion without dynamics (KinematicMotion), seconds; 0
  // to simulate all motion.
  double kinematic_step = 0.002;
  double force_limit = 300;  // newtons at the wrist; above it the arm stops
  noise::Noise noise = {};   // errors of the world, the hand and the sensors
  bool recovers = true;  // whether it recovers from errors that verifications signal, or ends there
  plan::StepId last = plan::StepId::None();
  // Measures the parts' poses; if null, sensors err as the noise says.
  sense::PoseSensor* sensor = nullptr;
  // Called after each timestep. It can stop the execution by an exception.
  std::function<void(const mujoco::Data&)> on_timestep = {};
  Observer* observer = nullptr;  // may be null
};

}  // namespace assay::execution
