#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "sim/check/certificate_claims/claim.h"

namespace assay::report {

// A verdict as it is shown to people. Some inconclusive verdicts only mean that the prediction is
// narrower than the engine's resolution. Such verdicts are no sign of an error, and have a name and
// a colour of their own.
enum class Standing {
  kContained,
  // Outside the prediction by no more than the claim's gate, which is the engine's resolution of
  // this quantity.
  kWithinResolution,
  // Outside by more than the gate, and not confirmed. The execution with half the timestep did not
  // reach the point where the quantity is observed (check::Confirmed).
  kInconclusive,
  kViolated,
  kNotClaimed,
};
inline constexpr std::array kStandings = {Standing::kContained, Standing::kWithinResolution,
                                          Standing::kInconclusive, Standing::kViolated,
                                          Standing::kNotClaimed};
std::string_view Name(Standing standing);
std::string_view TextOf(Standing standing);

// Returns the verdict with this name. An unknown name gives the verdict not claimed.
check::ClaimVerdict VerdictNamed(std::string_view name);

// A verdict as it is stored in the database: its name, like "inconclusive", and the claim's margin
// and gate in one unit. An unknown name counts as not claimed. The gate of a violation that was not
// confirmed is widened to exactly its margin.
struct StoredVerdict {
  std::string_view name;
  double margin = 0;
  double gate = 0;
};
Standing StandingOf(const StoredVerdict& verdict);
// Returns the standing of a record that has the members verdict, margin and gate.
Standing StandingOf(const auto& record) {
  return StandingOf(StoredVerdict{record.verdict, record.margin, record.gate});
}

// The number of verdicts of each standing.
class StandingCounts {
 public:
  void Add(Standing standing, std::int64_t count = 1) { Count(standing) += count; }
  std::int64_t Of(Standing standing) const { return counts_[static_cast<std::size_t>(standing)]; }
  std::int64_t Total() const;
  check::VerdictCounts Verdicts() const;
  StandingCounts& operator+=(const StandingCounts& other);

 private:
  std::int64_t& Count(Standing standing) { return counts_[static_cast<std::size_t>(standing)]; }

  std::array<std::int64_t, kStandings.size()> counts_{};
};

}  // namespace assay::report
