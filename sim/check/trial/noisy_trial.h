#pragma once

#include <string>
#include <vector>

#include "sim/check/claims/claim.h"
#include "sim/check/claims/noise_floor.h"
#include "sim/check/trial/verdict.h"
#include "sim/execution/walk/executor.h"
#include "sim/noise/noise.h"

namespace assay::check {

// A plan that is executed under noise.
struct Experiment {
  const domain::Problem& problem;
  const plan::Plan& plan;
  scene::SceneOptions scene = {};
  NoiseFloor gate = {};
};

// The result of one trial.
struct NoisyTrial {
  noise::Noise noise;
  execution::Trace trace;
  // The judgement on the whole plan. If a failure comes from the engine's timestep, the verdict's
  // reason says so.
  Verdict verdict;
  std::vector<Claim> claims;  // of the certificates of all steps that were executed
  int errors_signalled = 0;   // signalled by verifications
  int recovered = 0;          // errors after which the plan went on
  bool operator_called = false;
};

// Executes the plan in a world with this noise. Safe to call from many threads.
NoisyTrial RunNoisyTrial(const Experiment& experiment, const noise::Noise& noise,
                         execution::ExecutorOptions options);
// Executes the plan in a world with this noise and returns the verdict alone. Certificates are not
// checked, so nothing is executed again with half the timestep.
Verdict JudgeNoisyTrial(const Experiment& experiment, const noise::Noise& noise,
                        execution::ExecutorOptions options);

}  // namespace assay::check
