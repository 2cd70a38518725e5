#include "sim/check/certificate_claims/claim.h"

#include <algorithm>

#include "planner/base/check.h"

namespace assay::check {
std::string_view Name(ClaimVerdict verdict) {
  switch (verdict) {
    case ClaimVerdict::kContained:
      return "contained";
    case ClaimVerdict::kInconclusive:
      return "inconclusive";
    case ClaimVerdict::kViolated:
      return "violated";
    case ClaimVerdict::kNotClaimed:
      return "not-claimed";
  }
  ASSAY_CHECK(false, "a verdict that the switch does not know");
  return {};
}

int Rank(ClaimVerdict verdict) {
  switch (verdict) {
    case ClaimVerdict::kViolated:
      return 0;
    case ClaimVerdict::kInconclusive:
      return 1;
    case ClaimVerdict::kContained:
      return 2;
    case ClaimVerdict::kNotClaimed:
      return 3;
  }
  ASSAY_CHECK(false, "a verdict that the switch does not know");
  return 0;
}

std::string_view Name(Claimed claimed) {
  switch (claimed) {
    case Claimed::kBefore:
      return "before";
    case Claimed::kPrecondition:
      return "precondition";
    case Claimed::kAfter:
      return "after";
  }
  ASSAY_CHECK(false, "a subject that the switch does not know");
  return {};
}

double AsLength(double value, std::optional<domain::Dimension> dimension) {
  constexpr double kArm = 0.1;
  return dimension == domain::Dimension::kAngle ? kArm * value : value;
}

Claim Judged(Claim claim) {
  claim.margin =
      std::min(claim.observed - claim.predicted.low, claim.predicted.high - claim.observed);
  claim.verdict = claim.margin >= 0             ? ClaimVerdict::kContained
                  : claim.margin >= -claim.gate ? ClaimVerdict::kInconclusive
                                                : ClaimVerdict::kViolated;
  return claim;
}

bool IsSame(const Claim& a, const Claim& b) {
  return a.step == b.step && a.about == b.about && a.name == b.name;
}

bool IsWorse(const Claim& a, const Claim& b) {
  if (Rank(a.verdict) != Rank(b.verdict)) return Rank(a.verdict) < Rank(b.verdict);
  return AsLength(a.margin, a.dimension) < AsLength(b.margin, b.dimension);
}

void VerdictCounts::Add(ClaimVerdict verdict) {
  switch (verdict) {
    case ClaimVerdict::kContained:
      ++contained;
      return;
    case ClaimVerdict::kInconclusive:
      ++inconclusive;
      return;
    case ClaimVerdict::kViolated:
      ++violated;
      return;
    case ClaimVerdict::kNotClaimed:
      ++not_claimed;
      return;
  }
  ASSAY_CHECK(false, "a verdict that the switch does not know");
}

std::int64_t VerdictCounts::Of(ClaimVerdict verdict) const {
  switch (verdict) {
    case ClaimVerdict::kContained:
      return contained;
    case ClaimVerdict::kInconclusive:
      return inconclusive;
    case ClaimVerdict::kViolated:
      return violated;
    case ClaimVerdict::kNotClaimed:
      return not_claimed;
  }
  ASSAY_CHECK(false, "a verdict that the switch does not know");
  return 0;
}

VerdictCounts& VerdictCounts::operator+=(const VerdictCounts& other) {
  contained += other.contained;
  inconclusive += other.inconclusive;
  violated += other.violated;
  not_claimed += other.not_claimed;
  return *this;
}

std::vector<CertificateVerdict> ByStep(const std::vector<Claim>& claims) {
  std::vector<CertificateVerdict> verdicts;
  for (const Claim& claim : claims) {
    const auto found = std::ranges::find(verdicts, claim.step, &CertificateVerdict::step);
    if (found == verdicts.end()) {
      verdicts.push_back({claim.step, claim.verdict, claim});
    } else if (IsWorse(claim, found->worst)) {
      found->verdict = claim.verdict;
      found->worst = claim;
    }
  }
  return verdicts;
}

}  // namespace assay::check
