#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "sim/check/falsification/falsification_result.h"
#include "sim/check/noise_floor/noiseless.h"

namespace assay::check {

struct FalsificationOptions {
  // The number of attempts at single steps, in all. If this number is less than the number of
  // steps, each of the first steps has one attempt.
  std::int64_t attempts = 1000;
  std::uint64_t seed = 0;
  int jobs = 1;                 // threads; the result does not depend on it
  bool until_violated = false;  // end soon after the first attempt that violates a claim
  int shrunk = 3;  // the greatest number of violations that are shrunk to counterexamples
  // Called with the number of attempts made so far, from one thread at a time.
  std::function<void(std::int64_t)> progress = {};
  // This function is called before each attempt, from any thread. If it returns true, the
  // falsification ends with the results so far, and violations are kept as far as they are shrunk
  // by then. If it returns true when an execution throws Stopped (planner/base/stop.h), the attempt
  // of that execution is dropped. If the function is empty, all attempts are made.
  std::function<bool()> stop = {};
};

// Tries to falsify each certificate of a plan in the engine. The plan is first executed without
// noise. Then its steps are attempted in order, from states saved where the tool is poised for the
// step. First, corners of a design are tried. Next come corners at which claims are likely to be
// extreme, by the main effects that the design shows, and then points that fill the box evenly. The
// last attempts are those of a local search (NLopt) from the least margins found. The corners of
// the design are attempted to the step's end. Every other attempt is made for one claim and ends
// when that claim is decided, which is mostly where the tool is poised. All claims get the same
// simulated time, so claims that are decided sooner are attempted more often. The next step starts
// from the states whose errors are farthest out in each direction. The result is the same for any
// number of threads.
FalsificationResult Falsify(const Experiment& experiment, const FalsificationOptions& options);

}  // namespace assay::check
