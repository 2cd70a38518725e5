#include "sim/check/noise_floor/confirmation.h"

#include <algorithm>

namespace assay::check {
namespace {

// Replaces the observed value by its limit for a timestep of 0, if that is farther inside. The
// value is not moved beyond the other end of the prediction.
Claim Extrapolated(Claim claim, const Claim& finer) {
  if (finer.margin <= claim.margin) return claim;
  const double limit = 2 * finer.observed - claim.observed;
  claim.observed = claim.observed > claim.predicted.high ? std::max(limit, claim.predicted.low)
                                                         : std::min(limit, claim.predicted.high);
  return claim;
}

Claim Compared(Claim claim, const std::vector<Claim>& finer) {
  const auto same =
      std::ranges::find_if(finer, [&](const Claim& other) { return IsSame(claim, other); });
  if (same != finer.end()) return Judged(Extrapolated(std::move(claim), *same));
  if (std::ranges::none_of(finer, &Claim::IsViolated)) claim.gate = -claim.margin;
  return Judged(std::move(claim));
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
    if (claim.IsViolated()) claim = Compared(std::move(claim), with_half);
  }
  return claims;
}

}  // namespace assay::check
