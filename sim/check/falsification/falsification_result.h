#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "sim/check/certificate_claims/claim.h"
#include "sim/check/noise_floor/noiseless.h"

namespace assay::check {

// The method by which points of the error box were chosen.
enum class FalsificationPhase { kWithoutNoise, kVertices, kLikely, kLowDiscrepancy, kLocalSearch };
std::string_view Name(FalsificationPhase phase);

// The worst result of one claim.
struct WorstClaim {
  Claim claim;
  noise::Noise noise;
  FalsificationPhase phase = FalsificationPhase::kVertices;
  std::int64_t attempt = 0;  // from 1
};

// A violation, made as simple as possible (shrink.h).
struct Counterexample {
  Claim claim;
  noise::Noise noise;
  int steps = 0;          // number of steps for which the plan must be executed
  bool replayed = false;  // it shows from the start too, not only from a state saved on the way
  // True if the search for a simpler violation came to its end. The claim is then no longer
  // violated if one more error is left out, or if all remaining errors are made smaller.
  bool is_simplest = false;
  double multiple = 1;  // the least multiple of its errors, as far as tried, that still violates
};

struct FalsificationResult {
  Noiseless noiseless;  // if it does not hold, no step is attempted
  std::int64_t attempts = 0;
  std::vector<std::int64_t> attempts_at = {};        // each step, by StepId
  std::optional<std::int64_t> first_violation = {};  // number of the attempt; 0 without noise
  std::int64_t failed_approaches = 0;  // trials that did not come to where the next step begins
  std::vector<VerdictCounts> certificates;  // by StepId; counts the worst claim of each attempt
  VerdictCounts claims;
  std::vector<WorstClaim> worst;  // one for each step and claim, in the order of execution
  std::vector<Counterexample> counterexamples;
};

}  // namespace assay::check
