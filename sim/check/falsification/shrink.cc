#include "sim/check/falsification/shrink.h"

#include <algorithm>

#include "sim/noise/possible_start.h"

namespace assay::check {
namespace {

constexpr int kHalvings = 5;

noise::Noise Multiple(const noise::Noise& noise, double factor) {
  std::vector<double> values = noise.values();
  for (double& value : values) value *= factor;
  return {noise.box(), std::move(values)};
}

}  // namespace

std::optional<Claim> Replayed(const Experiment& experiment, const Claim& claim,
                              const noise::Noise& noise) {
  execution::ExecutorOptions options;
  options.sample_rate = 0;
  options.last = claim.step;
  options.recovers = false;
  for (Claim& replayed : RunTrial(experiment, noise, options).claims) {
    const bool same =
        replayed.step == claim.step && replayed.about == claim.about && replayed.name == claim.name;
    if (same) return std::move(replayed);
  }
  return std::nullopt;
}

Counterexample Shrunk(const Experiment& experiment, const WorstClaim& violation) {
  Counterexample example = {.claim = violation.claim,
                            .noise = violation.noise,
                            .steps = experiment.plan.step(violation.claim.step).executed};
  const auto replay = [&](const noise::Noise& noise) {
    return Replayed(experiment, violation.claim, noise);
  };
  const noise::PossibleStart start(experiment.problem);
  const auto accept = [&](const noise::Noise& noise) {
    if (start.FirstOverlap(noise)) return false;
    const std::optional<Claim> claim = replay(noise);
    if (!claim || !claim->IsViolated()) return false;
    example.claim = *claim;
    example.noise = noise;
    return true;
  };
  example.replayed = accept(violation.noise);
  if (!example.replayed) return example;
  for (std::size_t i = 0; i < example.noise.box().size(); ++i) {
    if (example.noise.values()[i] == 0) continue;
    noise::Noise without = example.noise;
    without.Set(i, 0);
    accept(without);
  }
  const noise::Noise all_of_it = example.noise;
  double holds = 0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (holds + example.multiple) / 2;
    (accept(Multiple(all_of_it, middle)) ? example.multiple : holds) = middle;
  }
  return example;
}

}  // namespace assay::check
