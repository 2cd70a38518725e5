#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "sim/check/claims/claim.h"

namespace assay::report {

// How a verdict is told to people. An inconclusive one is nothing to worry about where the
// prediction is only narrower than what the engine resolves: it has a name and a colour of its own.
enum class Standing {
  kContained,
  // Outside by less than the engine resolves for that very quantity (the claim's gate).
  kWithinResolution,
  // Outside by more, and not confirmed: the execution with half the timestep did not come to where
  // it can be observed (check::Confirmed).
  kInconclusive,
  kViolated,
  kNotClaimed,
};
inline constexpr std::array kStandings = {Standing::kContained, Standing::kWithinResolution,
                                          Standing::kInconclusive, Standing::kViolated,
                                          Standing::kNotClaimed};
std::string_view Name(Standing standing);    // "within-resolution", of its colour and its mark
std::string_view TextOf(Standing standing);  // "within the engine's resolution"

// By its name; a name that there is not is not claimed.
check::ClaimVerdict VerdictNamed(std::string_view name);

// A verdict as it is stored: its name ("inconclusive"; a name that no verdict has counts as not
// claimed), and the claim's margin and gate in one unit. A violation that was not confirmed has its
// gate widened to just its margin.
struct StoredVerdict {
  std::string_view name;
  double margin = 0;
  double gate = 0;
};
Standing StandingOf(const StoredVerdict& verdict);
// The standing of a record with a verdict, a margin and a gate.
Standing StandingOf(const auto& record) {
  return StandingOf(StoredVerdict{record.verdict, record.margin, record.gate});
}

// How many are told how.
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
