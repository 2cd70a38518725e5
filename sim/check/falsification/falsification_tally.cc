#include "sim/check/falsification/falsification_tally.h"

#include <algorithm>

namespace assay::check {

void FalsificationTally::Count(const Sample& sample) {
  ++result_.attempts;
  Count(sample.attempt.claims, sample.attempt.noise, sample.phase);
}

void FalsificationTally::Count(const std::vector<Claim>& claims, const noise::Noise& noise,
                               FalsificationPhase phase) {
  for (const CertificateVerdict& verdict : ByStep(claims)) {
    result_.certificates[verdict.step.index()].Add(verdict.verdict);
  }
  const bool violates = std::ranges::any_of(claims, &Claim::IsViolated);
  if (violates && !result_.first_violation) result_.first_violation = result_.attempts;
  for (const Claim& claim : claims) {
    result_.claims.Add(claim.verdict);
    if (claim.verdict == ClaimVerdict::kNotClaimed) continue;
    KeepIfWorst(claim, noise, phase);
  }
}

void FalsificationTally::KeepIfWorst(const Claim& claim, const noise::Noise& noise,
                                     FalsificationPhase phase) {
  const auto found = std::ranges::find_if(
      result_.worst, [&](const WorstClaim& worst) { return KeyOf(worst.claim) == KeyOf(claim); });
  const WorstClaim worst = {claim, noise, phase, result_.attempts};
  if (found == result_.worst.end()) {
    result_.worst.push_back(worst);
  } else if (IsWorse(claim, found->claim)) {
    *found = worst;
  }
}

}  // namespace assay::check
