#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/check/trial_verdicts/trial.h"

namespace assay::check {

// The errors that are varied together in a comparison.
struct VariedErrors {
  std::optional<noise::Effect> effect = {};      // none: all errors
  domain::PartId part = domain::PartId::None();  // as in noise::Channel

  bool Include(noise::Effect other, domain::PartId of = domain::PartId::None()) const {
    return !effect || (*effect == other && part == of);
  }
  bool operator==(const VariedErrors&) const = default;
};
// Returns the name of the errors that falsification varies: "x of peg", "yaw of the hand" or "all".
std::string NameOf(const domain::Problem& problem, const VariedErrors& errors);

// Options of a comparison of proofs with trials.
struct ConservatismOptions {
  std::uint64_t seed = 0;
  int jobs = 1;             // threads
  int corners = 16;         // trials at each multiple when several errors vary together
  double greatest = 64;     // the greatest multiple that is tried
  double precision = 0.25;  // relative precision of the multiples
  std::vector<VariedErrors> variables = {};  // empty: each variable, and all together
  // This function is called before each trial, by one thread at a time. If it returns true, the
  // comparison ends with the variables that are done. If the function is empty, all variables are
  // compared.
  std::function<bool()> stop = {};
};

// The error bounds that the planner guarantees, compared with the error bounds with which trials
// succeed.
struct ConservatismRatio {
  std::string variable;   // NameOf
  double guaranteed = 0;  // the greatest multiple of the errors with which all is proved
  // The smallest multiple of the errors with which a trial failed; missing if no trial failed.
  std::optional<double> broken = {};

  std::optional<double> ratio() const;  // broken / guaranteed; missing if guaranteed is 0
  // Returns whether a trial failed with errors for which all is proved. If so, the certificate is
  // false, which is worse than a failed task.
  bool IsFalse() const { return broken && *broken <= guaranteed; }
};

// Returns a ratio for each variable and for all together. The bounds of the variable are multiplied
// while the others have no error. The planner certifies the same actions with the multiplied
// bounds, and the plan is executed at the ends of the bounds. In both cases sensors err within
// their promise, which belongs to the workcell and is not multiplied.
std::vector<ConservatismRatio> Conservatism(const Experiment& experiment,
                                            const ConservatismOptions& options);

}  // namespace assay::check
