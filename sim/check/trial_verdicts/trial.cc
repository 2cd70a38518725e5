#include "sim/check/trial_verdicts/trial.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "sim/check/certificate_claims/certificate_check.h"
#include "sim/check/noise_floor/confirmation.h"
#include "sim/execution/walk/executor.h"
#include "sim/sense/overhead_camera.h"

namespace assay::check {
namespace {

constexpr char kFailureOfTheEngine[] =
    "; the engine's timestep caused the failure: with half the timestep the trial succeeds";

execution::Trace Traced(const Experiment& experiment, const scene::SceneOptions& nominal,
                        execution::ExecutorOptions options, Sensing sensing) {
  const scene::Scene scene(experiment.problem, execution::TrueScene(nominal, options.noise));
  mujoco::Data data = execution::StartOf(experiment.problem, scene, options.noise);
  // Each trial has a camera of its own, because a camera belongs to its thread and its scene.
  std::optional<sense::OverheadCamera> camera;
  if (sensing == Sensing::kCamera) options.sensor = &camera.emplace(scene, experiment.problem);
  return execution::Execute(experiment.problem, experiment.plan, scene, data, options);
}

std::vector<Claim> ClaimsOf(const Experiment& experiment, const execution::Trace& trace) {
  return CheckCertificates(experiment.problem, experiment.plan, trace, experiment.gate);
}

// A trial with half the timestep, which is executed when it is first asked for.
class WithHalfTheTimestep {
 public:
  WithHalfTheTimestep(const Experiment& experiment, execution::ExecutorOptions options,
                      Sensing sensing)
      : experiment_(experiment), options_(std::move(options)), sensing_(sensing) {
    options_.sample_rate = 0;
    options_.observer = nullptr;
  }

  const execution::Trace& trace() {
    if (!trace_) trace_ = Traced(experiment_, Finer(experiment_.scene), options_, sensing_);
    return *trace_;
  }

 private:
  const Experiment& experiment_;
  execution::ExecutorOptions options_;
  const Sensing sensing_;
  std::optional<execution::Trace> trace_;
};

// Adds to the reason of a failed verdict that the engine caused the failure, if the trial succeeds
// with half the timestep.
Verdict Attributed(const Experiment& experiment, Verdict verdict, WithHalfTheTimestep& finer) {
  if (verdict.outcome == TrialOutcome::kSucceeded) return verdict;
  if (Judge(experiment.problem, finer.trace(), {}).outcome == TrialOutcome::kSucceeded) {
    verdict.reason += kFailureOfTheEngine;
  }
  return verdict;
}

// Returns the number of steps that came to their end after an error. After each error a step is
// tried again, unless the operator is called, so its last try was without an error.
int Recovered(const execution::Trace& trace) {
  std::set<plan::StepId> mended;
  for (const execution::RecoveryRecord* recovery : trace.All<execution::RecoveryRecord>()) {
    const auto ended = [&](const execution::StepEnd* end) { return end->step == recovery->step; };
    if (std::ranges::any_of(trace.All<execution::StepEnd>(), ended)) mended.insert(recovery->step);
  }
  return static_cast<int>(mended.size());
}

}  // namespace

Trial RunTrial(const domain::Problem& problem, const plan::Plan& plan, const scene::Scene& scene,
               const execution::ExecutorOptions& options) {
  mujoco::Data data = scene.Start();
  Trial trial{.trace = execution::Execute(problem, plan, scene, data, options)};
  trial.verdict = Judge(problem, trial.trace, {});
  return trial;
}

Trial RunTrial(const Experiment& experiment, const noise::Noise& noise,
               execution::ExecutorOptions options, Sensing sensing) {
  options.noise = noise;
  execution::Trace trace = Traced(experiment, experiment.scene, options, sensing);
  WithHalfTheTimestep finer(experiment, options, sensing);
  Trial trial{.noise = noise,
              .trace = {},
              .verdict = Attributed(experiment, Judge(experiment.problem, trace, {}), finer),
              .claims = Confirmed(ClaimsOf(experiment, trace),
                                  [&] { return ClaimsOf(experiment, finer.trace()); })};
  for (const execution::VerificationRecord* check : trace.All<execution::VerificationRecord>()) {
    if (!check->error.empty()) ++trial.errors_signalled;
  }
  trial.operator_called = trace.end().outcome == execution::TrialOutcome::kOperatorCalled;
  trial.recovered = Recovered(trace);
  trial.trace = std::move(trace);
  return trial;
}

std::optional<Claim> ObserveAgain(const Experiment& experiment, const Claim& claim,
                                  const noise::Noise& noise) {
  execution::ExecutorOptions options;
  options.noise = noise;
  options.sample_rate = 0;
  options.last = claim.step;
  options.recovers = false;
  std::vector<Claim> claims =
      ClaimsOf(experiment, Traced(experiment, experiment.scene, options, Sensing::kDrawn));
  std::erase_if(claims, [&](const Claim& other) { return !IsSame(claim, other); });
  if (claims.empty()) return std::nullopt;
  WithHalfTheTimestep finer(experiment, options, Sensing::kDrawn);
  return Confirmed(std::move(claims), [&] { return ClaimsOf(experiment, finer.trace()); }).front();
}

Verdict JudgeTrial(const Experiment& experiment, const noise::Noise& noise,
                   execution::ExecutorOptions options) {
  options.noise = noise;
  return Judge(experiment.problem,
               Traced(experiment, experiment.scene, std::move(options), Sensing::kDrawn), {});
}

}  // namespace assay::check
