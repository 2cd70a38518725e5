#include "sim/execution/trial/trial_outcome.h"

#include <array>
#include <cstddef>

namespace assay::execution {

std::string_view Name(TrialOutcome outcome) {
  static constexpr std::array<std::string_view, 26> kNames = {
      "succeeded",   "unreachable",     "overload",     "too-heavy",  "engine-warning",
      "not-found",   "operator-called", "jammed",       "wedged",     "wrong-contact",
      "timeout",     "dropped",         "stopped",      "uncertain",  "endless",
      "false-claim", "collided",        "grasp-failed", "not-seated", "misaligned",
      "not-located", "not-released",    "not-at-rest",  "spilled",    "fallen",
      "missed"};
  return kNames[static_cast<std::size_t>(outcome)];
}

std::string_view NameOfEnd(TrialOutcome outcome) {
  return outcome == TrialOutcome::kSucceeded ? "done" : Name(outcome);
}

}  // namespace assay::execution
