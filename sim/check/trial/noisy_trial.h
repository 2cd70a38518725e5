#pragma once

#include <string>
#include <vector>

#include "sim/check/claims/claim.h"
#include "sim/check/claims/honesty_gate.h"
#include "sim/check/trial/verdict.h"
#include "sim/exec/execution/executor.h"
#include "sim/noise/noise.h"

namespace assay::check {

// A plan that is executed under noise.
struct Experiment {
  const domain::Problem& problem;
  const plan::Plan& plan;
  scene::SceneOptions scene = {};
  HonestyGate gate = {};
};

// What became of one trial.
struct NoisyTrial {
  noise::Noise noise;
  exec::Trace trace;
  Verdict verdict;  // of the plan as a whole; its reason tells if the engine's timestep is to blame
  std::vector<Claim> claims;  // of the certificates of all steps that were executed
  int errors_signalled = 0;   // by verifications
  int recovered = 0;          // errors after which the plan went on
  bool operator_called = false;
};

// Executes the plan in a world with this noise. Safe to call from many threads.
NoisyTrial RunNoisyTrial(const Experiment& experiment, const noise::Noise& noise,
                         exec::ExecutorOptions options);
// The same, for who does not ask what became of the certificates, so that nothing is executed again
// with half the timestep.
Verdict JudgeNoisyTrial(const Experiment& experiment, const noise::Noise& noise,
                        exec::ExecutorOptions options);

}  // namespace assay::check
