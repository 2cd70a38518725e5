#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/check/trial/noisy_trial.h"

namespace assay::check {

struct ConservatismOptions {
  std::uint64_t seed = 0;
  int jobs = 1;                             // threads
  int corners = 16;                         // trials at each multiple, of several errors together
  double greatest = 64;                     // multiple that is tried
  double precision = 0.25;                  // of the multiples, relative
  std::vector<std::string> variables = {};  // only these; empty: every one, and all together
  // Asked before each trial, from any thread: true ends the comparison with those variables that
  // are done. Empty: never.
  std::function<bool()> stop = {};
};

// How much of what physics forgives the planner guarantees, for one variable alone ("x of peg",
// "yaw of the hand") or for all together ("all").
struct ConservatismRatio {
  std::string variable;
  double guaranteed = 0;              // the greatest multiple with which all is proved
  std::optional<double> broken = {};  // the smallest one with which a trial failed; none: none did

  std::optional<double> ratio() const;  // of broken to guaranteed; none if that is 0
  // A trial failed with no more than what all is proved for: a false certificate, not only a task
  // that fails.
  bool IsFalse() const { return broken && *broken <= guaranteed; }
};

// Multiplies the bounds of one variable, the others without error, and of all; asks the planner's
// certificates for the same actions, and executes the plan at the ends of the bounds. Sensors err
// within their promise in both, since that belongs to the workcell and is not multiplied.
std::vector<ConservatismRatio> Conservatism(const Experiment& experiment,
                                            const ConservatismOptions& options);

}  // namespace assay::check
