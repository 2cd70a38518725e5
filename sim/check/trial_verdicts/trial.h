#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/check/certificate_claims/claim.h"
#include "sim/check/noise_floor/noise_floor.h"
#include "sim/check/trial_verdicts/verdict.h"
#include "sim/execution/walk/executor.h"
#include "sim/noise/noise.h"

namespace assay::check {

// A plan that is executed in trials.
struct Experiment {
  const domain::Problem& problem;
  const plan::Plan& plan;
  scene::SceneOptions scene = {};
  NoiseFloor gate = {};
};

// The way in which a sensor of the plan measures in a trial.
enum class Sensing {
  kDrawn,   // its error is drawn from the error box, within the promise of the sensor
  kCamera,  // it finds the parts in rendered pictures
};

// One execution of a plan, and its results.
struct Trial {
  int number = 1;  // from 1
  noise::Noise noise = {};
  execution::Trace trace = {};
  // The judgement on the whole plan. If a failure comes from the engine's timestep, the verdict's
  // reason says so.
  Verdict verdict = {};
  // Claims of the certificates of all steps that were executed; empty without noise.
  std::vector<Claim> claims = {};
  int errors_signalled = 0;  // signalled by verifications
  int recovered = 0;         // errors after which the plan went on
  bool operator_called = false;
};

// Executes the plan in the scene, where every part lies as the problem says, and judges the
// execution. No certificate is checked. Many threads may call this function at the same time.
Trial RunTrial(const domain::Problem& problem, const plan::Plan& plan, const scene::Scene& scene,
               const execution::ExecutorOptions& options);
// Executes the plan in a world with this noise, judges it, and checks its certificates. Safe to
// call from many threads.
Trial RunTrial(const Experiment& experiment, const noise::Noise& noise,
               execution::ExecutorOptions options, Sensing sensing = Sensing::kDrawn);
// Executes the plan in a world with this noise up to the step of the claim, and returns the claim
// with what was observed in this execution. The result is empty if the execution does not observe
// the claim. No other claim is judged, because a violation of another claim would cause a further
// execution with half the timestep.
std::optional<Claim> ObserveAgain(const Experiment& experiment, const Claim& claim,
                                  const noise::Noise& noise);
// Executes the plan in a world with this noise and returns the verdict alone. Certificates are not
// checked, so nothing is executed again with half the timestep.
Verdict JudgeTrial(const Experiment& experiment, const noise::Noise& noise,
                   execution::ExecutorOptions options);

}  // namespace assay::check
