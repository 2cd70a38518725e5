#include "sim/check/falsification/tried_points.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "sim/check/falsification/main_effects.h"
#include "sim/noise/sampling.h"

namespace assay::check {
namespace {

// Returns, for each claim that occurs in all samples and depends on the errors, its observed values
// at the corners of the samples.
std::map<ClaimKey, std::vector<CornerResponse>> Responses(TriedStep& step) {
  std::map<ClaimKey, std::vector<CornerResponse>> responses;
  for (const Sample& sample : step.samples()) {
    for (const Claim& claim : sample.attempt.claims) {
      if (claim.verdict == ClaimVerdict::kNotClaimed || !claim.dimension) continue;
      responses[KeyOf(claim)].push_back({&sample.point, sample.start, claim.observed});
    }
  }
  std::erase_if(responses,
                [&](const auto& entry) { return entry.second.size() != step.samples().size(); });
  return responses;
}

}  // namespace

double Length(const Claim& claim) { return AsLength(claim.margin, claim.dimension); }

const Claim* Find(const std::vector<Claim>& claims, const ClaimKey& key) {
  const auto found =
      std::ranges::find_if(claims, [&](const Claim& claim) { return KeyOf(claim) == key; });
  return found == claims.end() ? nullptr : &*found;
}

std::vector<Sample> DesignCorners(TriedStep& step, std::uint64_t seed, std::int64_t count) {
  std::vector<Sample> samples;
  for (int n = 0; n < count; ++n) {
    samples.push_back({static_cast<std::size_t>(n / 2) % step.poised().size(),
                       noise::CornerPoint(step.dimensions(), seed, 1 + n)});
  }
  return samples;
}

std::vector<Sample> LikelyCorners(TriedStep& step, std::int64_t count) {
  std::vector<std::pair<double, Sample>> likely;
  for (const auto& [key, responses] : Responses(step)) {
    const Claim& claim = *Find(step.samples().front().attempt.claims, key);
    const Until until = step.AimAt(key)->until;
    const LikelyExtremes extremes = ByMainEffects(responses);
    const auto add = [&](const LikelyExtreme& extreme, double margin) {
      if (!std::isfinite(margin)) return;
      likely.emplace_back(
          AsLength(margin, claim.dimension),
          Sample{extreme.start, extreme.corner, FalsificationPhase::kLikely, until});
    };
    add(extremes.least, extremes.least.expected - claim.predicted.low);
    add(extremes.greatest, claim.predicted.high - extremes.greatest.expected);
  }
  std::ranges::stable_sort(likely, {}, [](const auto& entry) { return entry.first; });
  std::map<std::pair<std::size_t, std::vector<double>>, Until> seen;
  for (const Sample& sample : step.samples()) seen[{sample.start, sample.point}] = sample.until;
  std::vector<Sample> samples;
  for (auto& [margin, sample] : likely) {
    if (std::ssize(samples) == count) break;
    const auto [before, is_new] = seen.try_emplace({sample.start, sample.point}, sample.until);
    if (!is_new && before->second >= sample.until) continue;
    before->second = sample.until;
    samples.push_back(std::move(sample));
  }
  return samples;
}

std::vector<Sample> EvenPoints(TriedStep& step, std::uint64_t seed, std::int64_t count) {
  std::vector<Sample> samples;
  const std::vector<std::int64_t> counts = Allotted(count, step.aims());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    for (std::int64_t of_aim = 0; of_aim < counts[i]; ++of_aim) {
      const int n = static_cast<int>(samples.size());
      samples.push_back({static_cast<std::size_t>(n) % step.poised().size(),
                         noise::EvenPoint(step.dimensions(), seed, 1 + n),
                         FalsificationPhase::kLowDiscrepancy, step.aims()[i].until});
    }
  }
  return samples;
}

std::vector<std::pair<ClaimKey, const Sample*>> LeastMargins(TriedStep& step) {
  std::map<ClaimKey, std::pair<double, const Sample*>> least;
  for (const Sample& sample : step.samples()) {
    for (const Claim& claim : sample.attempt.claims) {
      if (claim.verdict == ClaimVerdict::kNotClaimed) continue;
      if (claim.predicted.high - claim.predicted.low <= 2 * claim.gate) continue;
      const double margin = Length(claim);
      const auto [at, is_new] = least.try_emplace(KeyOf(claim), margin, &sample);
      if (!is_new && margin < at->second.first) at->second = {margin, &sample};
    }
  }
  std::vector<std::pair<ClaimKey, const Sample*>> sorted;
  for (const auto& [key, value] : least) sorted.emplace_back(key, value.second);
  std::ranges::stable_sort(sorted, {},
                           [&](const auto& entry) { return least.at(entry.first).first; });
  return sorted;
}

}  // namespace assay::check
