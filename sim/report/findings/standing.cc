#include "sim/report/findings/standing.h"

#include <numeric>

#include "planner/base/check.h"

namespace assay::report {

using check::ClaimVerdict;

std::string_view Name(Standing standing) {
  switch (standing) {
    case Standing::kContained:
      return "contained";
    case Standing::kWithinResolution:
      return "within-resolution";
    case Standing::kInconclusive:
      return "inconclusive";
    case Standing::kViolated:
      return "violated";
    case Standing::kNotClaimed:
      return "not-claimed";
  }
  ASSAY_CHECK(false, "a standing that the switch does not know");
  return {};
}

std::string_view TextOf(Standing standing) {
  if (standing == Standing::kWithinResolution) return "within the engine’s resolution";
  if (standing == Standing::kNotClaimed) return "not claimed";
  return Name(standing);
}

ClaimVerdict VerdictNamed(std::string_view name) {
  for (const auto verdict :
       {ClaimVerdict::kContained, ClaimVerdict::kInconclusive, ClaimVerdict::kViolated}) {
    if (check::Name(verdict) == name) return verdict;
  }
  return ClaimVerdict::kNotClaimed;
}

Standing StandingOf(const StoredVerdict& verdict) {
  switch (VerdictNamed(verdict.name)) {
    case ClaimVerdict::kContained:
      return Standing::kContained;
    case ClaimVerdict::kInconclusive:
      return verdict.margin > -verdict.gate ? Standing::kWithinResolution : Standing::kInconclusive;
    case ClaimVerdict::kViolated:
      return Standing::kViolated;
    case ClaimVerdict::kNotClaimed:
      return Standing::kNotClaimed;
  }
  ASSAY_CHECK(false, "a verdict that the switch does not know");
  return Standing::kNotClaimed;
}

std::int64_t StandingCounts::Total() const {
  return std::accumulate(counts_.begin(), counts_.end(), std::int64_t{0});
}

check::VerdictCounts StandingCounts::Verdicts() const {
  return {.contained = Of(Standing::kContained),
          .inconclusive = Of(Standing::kWithinResolution) + Of(Standing::kInconclusive),
          .violated = Of(Standing::kViolated),
          .not_claimed = Of(Standing::kNotClaimed)};
}

StandingCounts& StandingCounts::operator+=(const StandingCounts& other) {
  for (const Standing standing : kStandings) Add(standing, other.Of(standing));
  return *this;
}

}  // namespace assay::report
