#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "sim/check/claims/claim.h"
#include "sim/check/claims/noiseless.h"

namespace assay::check {

// How points of the error box were chosen.
enum class AttackPhase { kWithoutNoise, kVertices, kLikely, kLowDiscrepancy, kLocalSearch };
std::string_view Name(AttackPhase phase);

// A claim as it came out at its worst.
struct WorstClaim {
  Claim claim;
  noise::Noise noise;
  AttackPhase phase = AttackPhase::kVertices;
  std::int64_t attempt = 0;  // from 1
};

// A violation in as few words as possible: leave out one more error, or halve what is left, and
// there is none.
struct Counterexample {
  Claim claim;
  noise::Noise noise;
  int steps = 0;          // how far the plan must be executed
  bool replayed = false;  // also from the start of the plan, not only from a saved state
  double multiple = 1;    // of its errors, with which it is violated still
};

struct AttackResult {
  Noiseless noiseless;  // if it does not hold, nothing is attempted
  std::int64_t attempts = 0;
  std::optional<std::int64_t> first_violation = {};  // number of the attempt; 0: without noise
  std::int64_t failed_approaches = 0;  // trials that did not come to where the next step begins
  std::vector<VerdictCounts> certificates;  // by StepId; of an attempt: its worst claim
  VerdictCounts claims;
  std::vector<WorstClaim> worst;  // of each step and claim, in the order of execution
  std::vector<Counterexample> counterexamples;
};

}  // namespace assay::check
