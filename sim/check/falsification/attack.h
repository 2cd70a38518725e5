#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "sim/check/claims/noiseless.h"
#include "sim/check/falsification/attack_result.h"

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
