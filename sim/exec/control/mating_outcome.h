#pragma once

#include <string_view>

namespace assay::exec {

// How a mating by a strategy, or a motion of it, ended, as far as the arm can tell.
enum class MatingOutcome {
  kDone,           // every motion was made
  kJammed,         // it stopped short of its end; without the push it is free
  kWedged,         // it stopped short of its end, and cannot be drawn back either
  kWrongContact,   // something touched that was not to
  kTimeout,        // a contact that was to end a motion did not come
  kOverload,       // the wrist felt more force than it may: protective stop
  kUnreachable,    // the arm cannot go on
  kDropped,        // the part is no longer in the hand
  kEngineWarning,  // the engine's numbers cannot be trusted
};
std::string_view Name(MatingOutcome outcome);  // "wrong-contact"

}  // namespace assay::exec
