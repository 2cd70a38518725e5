#include "sim/execution/control/mating_outcome.h"

namespace assay::execution {

std::string_view Name(MatingOutcome outcome) {
  switch (outcome) {
    case MatingOutcome::kDone:
      return "done";
    case MatingOutcome::kJammed:
      return "jammed";
    case MatingOutcome::kWedged:
      return "wedged";
    case MatingOutcome::kWrongContact:
      return "wrong-contact";
    case MatingOutcome::kTimeout:
      return "timeout";
    case MatingOutcome::kOverload:
      return "overload";
    case MatingOutcome::kUnreachable:
      return "unreachable";
    case MatingOutcome::kDropped:
      return "dropped";
    case MatingOutcome::kEngineWarning:
      return "engine-warning";
  }
  return {};
}

}  // namespace assay::execution
