#pragma once

#include <functional>

#include "planner/plan/plan.h"
#include "sim/exec/trace.h"
#include "sim/scene/scene.h"

namespace assay::exec {

struct ExecutorOptions {
  double sample_rate = 50;       // moments of the trace's series per simulated second
  double free_timestep = 0.002;  // seconds, while the empty hand touches nothing
  double force_limit = 300;      // newtons at the wrist, then the arm stops
  // Told of the end of each step as it comes, with the simulation: to take a picture of it.
  std::function<void(const StepEnd&, const mujoco::Data&)> on_step_end = {};
};

// Executes a plan, asking the planner nothing. `data` is a simulation of `scene` at the start of
// the trial, the parts wherever they truly are, and afterwards at its end. The problem tells where
// they are believed to be.
Trace Execute(const domain::Problem& problem, const plan::Plan& plan, const scene::Scene& scene,
              mujoco::Data& data, const ExecutorOptions& options);

}  // namespace assay::exec
