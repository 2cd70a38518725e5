#include "sim/check/falsification/tried_step.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace assay::check {

ClaimKey KeyOf(const Claim& claim) { return {claim.step, claim.about, claim.name}; }

std::vector<std::int64_t> Allotted(std::int64_t attempts, const std::vector<Aim>& aims) {
  double all = 0;
  for (const Aim& aim : aims) all += 1 / aim.seconds;
  std::vector<std::int64_t> counts;
  double sum = 0;
  std::int64_t given = 0;
  for (const Aim& aim : aims) {
    sum += 1 / aim.seconds;
    const auto by_now = std::llround(static_cast<double>(attempts) * sum / all);
    counts.push_back(by_now - given);
    given = by_now;
  }
  return counts;
}

TriedStep::TriedStep(const Experiment& experiment, plan::StepId id, const noise::Noise& noise)
    : falsification_(experiment, id, noise) {
  for (const std::size_t i : falsification_.free_channels())
    ranges_.push_back(noise.box()[i].range);
}

std::vector<double> TriedStep::At(const std::vector<double>& point) const {
  std::vector<double> values(point.size());
  for (std::size_t i = 0; i < point.size(); ++i) {
    values[i] = (1 - point[i]) * ranges_[i].low + point[i] * ranges_[i].high;
  }
  return values;
}

StepAttempt TriedStep::Attempt(const Sample& sample) const {
  StepAttempt attempt =
      falsification_.Attempt(poised_[sample.start], At(sample.point), sample.until);
  if (attempt.IsWhole()) return attempt;
  std::erase_if(attempt.claims, [&](const Claim& claim) {
    const Aim* const aim = AimAt(KeyOf(claim));
    return !claim.IsViolated() && (aim == nullptr || aim->until > sample.until);
  });
  return attempt;
}

void TriedStep::FindAims() {
  std::map<ClaimKey, Aim> aims;
  for (const Sample& sample : samples_) {
    const std::vector<Decision>& decisions = sample.attempt.decisions;
    for (std::size_t i = 0; i < decisions.size(); ++i) {
      const Claim& claim = sample.attempt.claims[i];
      if (claim.verdict == ClaimVerdict::kNotClaimed || !claim.dimension) continue;
      Aim& aim = aims.try_emplace(KeyOf(claim), Aim{KeyOf(claim), Until::kPoised}).first->second;
      aim.until = std::max(aim.until, decisions[i].until);
      aim.seconds = std::max(aim.seconds, decisions[i].seconds);
    }
  }
  aims_.clear();
  for (auto& [key, aim] : aims) aims_.push_back(std::move(aim));
}

const Aim* TriedStep::AimAt(const ClaimKey& claim) const {
  const auto found = std::ranges::find(aims_, claim, &Aim::claim);
  return found == aims_.end() ? nullptr : &*found;
}

}  // namespace assay::check
