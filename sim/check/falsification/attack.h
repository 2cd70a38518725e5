#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "sim/check/claims/claim.h"
#include "sim/check/claims/noiseless.h"

namespace assay::check {

struct AttackOptions {
  std::int64_t attempts = 1000;  // of single steps, from saved states; in all
  std::uint64_t seed = 0;
  int jobs = 1;                 // threads; they change nothing
  bool until_violated = false;  // ends soon after the first attempt that violates something
  int shrunk = 3;               // at most so many violations are shrunk to counterexamples
  // Told of how many attempts were made so far; from one thread at a time.
  std::function<void(std::int64_t)> progress = {};
  // Asked before each attempt, from any thread: true ends the attack with what it has until then,
  // whose violations are not shrunk. Empty: never.
  std::function<bool()> stop = {};
};

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

// Tries to break each certificate of a plan in physics. First without noise. Then step after step,
// from states saved where the tool is poised for it: corners of the error box, then those at which
// claims are likely to be farthest out by the main effects that errors had up to then, then points
// that fill the box evenly, then local search (NLopt) on the least margins found. The first corners
// are attempted to the step's end; every other attempt is made for one claim, and ends when that is
// decided, which is mostly where the tool is poised. Claims get the same simulated time, so that
// those that are decided sooner are attempted more often. States for the next step are those whose
// errors are farthest out, each way. The same for any number of threads.
AttackResult Attack(const Experiment& experiment, const AttackOptions& options);

}  // namespace assay::check
