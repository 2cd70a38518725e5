#pragma once

#include <string_view>

namespace assay::execution {

// The end of a mating by a strategy, or of one of its motions, as far as the arm can detect it.
enum class MatingOutcome {
  kDone,           // every motion was completed
  kJammed,         // the part stopped short of its end, and is free without the push
  kWedged,         // the part stopped short of its end, and cannot be drawn back either
  kWrongContact,   // something touched that should not touch
  kTimeout,        // the contact that should end a motion did not come
  kOverload,       // the wrist felt too much force: protective stop
  kUnreachable,    // the arm cannot go on
  kDropped,        // the part is no longer in the hand
  kEngineWarning,  // the engine's numbers cannot be trusted
};
std::string_view Name(MatingOutcome outcome);  // for example "wrong-contact"

}  // namespace assay::execution
