#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "sim/check/claims/claim.h"
#include "sim/check/claims/noiseless.h"

namespace assay::check {

// Options of a falsification, which attempts single steps from saved states.
struct AttackOptions {
  std::int64_t attempts = 1000;  // attempts at single steps, in all
  std::uint64_t seed = 0;
  int jobs = 1;                 // threads; the result does not depend on it
  bool until_violated = false;  // end soon after the first attempt that violates a claim
  int shrunk = 3;  // the greatest number of violations that are shrunk to counterexamples
  // Called with the number of attempts made so far, from one thread at a time.
  std::function<void(std::int64_t)> progress = {};
  // Asked before each attempt, from any thread. True ends the falsification with the results so
  // far, and its violations are not shrunk. An empty function never ends it.
  std::function<bool()> stop = {};
};

// The method by which points of the error box were chosen.
enum class AttackPhase { kWithoutNoise, kVertices, kLikely, kLowDiscrepancy, kLocalSearch };
std::string_view Name(AttackPhase phase);

// The worst result of one claim.
struct WorstClaim {
  Claim claim;
  noise::Noise noise;
  AttackPhase phase = AttackPhase::kVertices;
  std::int64_t attempt = 0;  // from 1
};

// A violation made as simple as possible: if one more error is left out, or all that are left are
// made smaller, the claim is no longer violated.
struct Counterexample {
  Claim claim;
  noise::Noise noise;
  int steps = 0;  // number of steps for which the plan must be executed
  // Says whether it is violated from the start of the plan as well, not only from a saved state.
  bool replayed = false;
  double multiple = 1;  // the least multiple of its errors, as far as tried, that still violates
};

// The result of a falsification.
struct AttackResult {
  Noiseless noiseless;  // if it does not hold, no step is attempted
  std::int64_t attempts = 0;
  std::optional<std::int64_t> first_violation = {};  // number of the attempt; 0 without noise
  std::int64_t failed_approaches = 0;  // trials that did not come to where the next step begins
  std::vector<VerdictCounts> certificates;  // by StepId; counts the worst claim of each attempt
  VerdictCounts claims;
  std::vector<WorstClaim> worst;  // one for each step and claim, in the order of execution
  std::vector<Counterexample> counterexamples;
};

// Tries to falsify each certificate of a plan in the engine. The plan is first executed without
// noise. Then its steps are attempted in order, from states saved where the tool is poised for the
// step. The points of the error box are tried in this sequence: corners of a design; corners at
// which claims are likely to be extreme, by the main effects that the design shows; points that
// fill the box evenly; and a local search (NLopt) from the least margins found. The corners of the
// design are attempted to the step's end. Every other attempt is made for one claim and ends when
// that claim is decided, which is mostly where the tool is poised. All claims get the same
// simulated time, so that claims that are decided sooner are attempted more often. The next step
// starts from the states whose errors are farthest out in each direction. The result is the same
// for any number of threads.
AttackResult Attack(const Experiment& experiment, const AttackOptions& options);

}  // namespace assay::check
