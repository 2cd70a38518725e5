#include "sim/check/noisy_trial.h"

#include <algorithm>

#include "sim/check/certificate_check.h"
#include "sim/check/confirmation.h"

namespace assay::check {
namespace {

exec::Trace Traced(const Experiment& experiment, const scene::SceneOptions& nominal,
                   const exec::ExecutorOptions& options) {
  const scene::Scene scene(experiment.problem, exec::TrueScene(nominal, options.noise));
  mujoco::Data data = exec::StartOf(experiment.problem, scene, options.noise);
  return exec::Execute(experiment.problem, experiment.plan, scene, data, options);
}

std::vector<Claim> ClaimsOf(const Experiment& experiment, const exec::Trace& trace) {
  return CheckCertificates(experiment.problem, experiment.plan, trace, experiment.gate);
}

std::vector<Claim> ConfirmedClaims(const Experiment& experiment, const exec::Trace& trace,
                                   exec::ExecutorOptions options) {
  return Confirmed(ClaimsOf(experiment, trace), [&] {
    options.sample_rate = 0;
    options.observer = nullptr;
    return ClaimsOf(experiment, Traced(experiment, Finer(experiment.scene), options));
  });
}

}  // namespace

NoisyTrial RunNoisyTrial(const Experiment& experiment, const noise::Noise& noise,
                         exec::ExecutorOptions options) {
  options.noise = noise;
  exec::Trace trace = Traced(experiment, experiment.scene, options);
  NoisyTrial trial{.noise = noise,
                   .trace = {},
                   .verdict = Judge(experiment.problem, trace, {}),
                   .claims = ConfirmedClaims(experiment, trace, options)};
  for (const exec::VerificationRecord* check : trace.All<exec::VerificationRecord>()) {
    if (!check->error.empty()) ++trial.errors_signalled;
  }
  trial.operator_called = trace.end().outcome == exec::ExecutionOutcome::kOperatorCalled;
  // Every error but one that the operator was called for was followed by another try, and the last
  // try of a step that went on mended it.
  std::vector<plan::StepId> mended;
  for (const exec::RecoveryRecord* recovery : trace.All<exec::RecoveryRecord>()) {
    const auto ended = [&](const exec::StepEnd* end) { return end->step == recovery->step; };
    if (std::ranges::any_of(trace.All<exec::StepEnd>(), ended)) mended.push_back(recovery->step);
  }
  std::ranges::sort(mended);
  trial.recovered = static_cast<int>(std::ranges::unique(mended).begin() - mended.begin());
  trial.trace = std::move(trace);
  return trial;
}

Verdict JudgeNoisyTrial(const Experiment& experiment, const noise::Noise& noise,
                        exec::ExecutorOptions options) {
  options.noise = noise;
  return Judge(experiment.problem, Traced(experiment, experiment.scene, options), {});
}

}  // namespace assay::check
