#include "sim/check/trial/noisy_trial.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "sim/check/claims/certificate_check.h"
#include "sim/check/claims/confirmation.h"
#include "sim/execution/walk/executor.h"

namespace assay::check {
namespace {

constexpr char kFailureOfTheEngine[] =
    "; the engine's timestep caused the failure: with half the timestep the trial succeeds";

execution::Trace Traced(const Experiment& experiment, const scene::SceneOptions& nominal,
                        const execution::ExecutorOptions& options) {
  const scene::Scene scene(experiment.problem, execution::TrueScene(nominal, options.noise));
  mujoco::Data data = execution::StartOf(experiment.problem, scene, options.noise);
  return execution::Execute(experiment.problem, experiment.plan, scene, data, options);
}

std::vector<Claim> ClaimsOf(const Experiment& experiment, const execution::Trace& trace) {
  return CheckCertificates(experiment.problem, experiment.plan, trace, experiment.gate);
}

// A trial with half the timestep, which is executed when it is first asked for.
class WithHalfTheTimestep {
 public:
  WithHalfTheTimestep(const Experiment& experiment, execution::ExecutorOptions options)
      : experiment_(experiment), options_(std::move(options)) {
    options_.sample_rate = 0;
    options_.observer = nullptr;
  }

  const execution::Trace& trace() {
    if (!trace_) trace_ = Traced(experiment_, Finer(experiment_.scene), options_);
    return *trace_;
  }

 private:
  const Experiment& experiment_;
  execution::ExecutorOptions options_;
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

}  // namespace

NoisyTrial RunNoisyTrial(const Experiment& experiment, const noise::Noise& noise,
                         execution::ExecutorOptions options) {
  options.noise = noise;
  execution::Trace trace = Traced(experiment, experiment.scene, options);
  WithHalfTheTimestep finer(experiment, options);
  NoisyTrial trial{.noise = noise,
                   .trace = {},
                   .verdict = Attributed(experiment, Judge(experiment.problem, trace, {}), finer),
                   .claims = Confirmed(ClaimsOf(experiment, trace),
                                       [&] { return ClaimsOf(experiment, finer.trace()); })};
  for (const execution::VerificationRecord* check : trace.All<execution::VerificationRecord>()) {
    if (!check->error.empty()) ++trial.errors_signalled;
  }
  trial.operator_called = trace.end().outcome == execution::TrialOutcome::kOperatorCalled;
  // After each error the step was tried again, unless the operator was called. If a step with an
  // error came to its end, its last try was without an error.
  std::vector<plan::StepId> mended;
  for (const execution::RecoveryRecord* recovery : trace.All<execution::RecoveryRecord>()) {
    const auto ended = [&](const execution::StepEnd* end) { return end->step == recovery->step; };
    if (std::ranges::any_of(trace.All<execution::StepEnd>(), ended))
      mended.push_back(recovery->step);
  }
  std::ranges::sort(mended);
  trial.recovered = static_cast<int>(std::ranges::unique(mended).begin() - mended.begin());
  trial.trace = std::move(trace);
  return trial;
}

Verdict JudgeNoisyTrial(const Experiment& experiment, const noise::Noise& noise,
                        execution::ExecutorOptions options) {
  options.noise = noise;
  return Judge(experiment.problem, Traced(experiment, experiment.scene, options), {});
}

}  // namespace assay::check
