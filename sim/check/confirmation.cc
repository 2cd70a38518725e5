#include "sim/check/confirmation.h"

#include <algorithm>

namespace assay::check {
namespace {

// How much of a margin is the timestep's.
double OfTheTimestep(const Claim& claim, const std::vector<Claim>& finer) {
  const auto same = std::ranges::find_if(finer, [&](const Claim& other) {
    return other.step == claim.step && other.about == claim.about && other.name == claim.name;
  });
  if (same == finer.end() || same->verdict == ClaimVerdict::kNotClaimed) return -claim.margin;
  return 2 * std::max(0.0, same->margin - claim.margin);
}

}  // namespace

scene::SceneOptions Finer(scene::SceneOptions options) {
  options.timestep /= 2;
  return options;
}

std::vector<Claim> Confirmed(std::vector<Claim> claims,
                             const std::function<std::vector<Claim>()>& finer) {
  if (std::ranges::none_of(claims, &Claim::IsViolated)) return claims;
  const std::vector<Claim> with_half = finer();
  for (Claim& claim : claims) {
    if (!claim.IsViolated()) continue;
    claim.gate += OfTheTimestep(claim, with_half);
    claim = Judged(std::move(claim));
  }
  return claims;
}

}  // namespace assay::check
