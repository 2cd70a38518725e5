#include "sim/execution/trial/trial_outcome.h"

#include <array>
#include <cstddef>

namespace assay::execution {

std::string_view Name(TrialOutcome outcome) {
  static constexpr std::array<std::string_view, 20> kNames = {
      "succeeded",       "unreachable", "overload",    "engine-warning", "not-found",
      "operator-called", "stopped",     "uncertain",   "endless",        "false-claim",
      "collided",        "grasp-failed", "not-seated", "misaligned",     "not-located",
      "not-released",    "not-at-rest", "spilled",     "fallen",         "missed"};
  return kNames[static_cast<std::size_t>(outcome)];
}

}  // namespace assay::execution
