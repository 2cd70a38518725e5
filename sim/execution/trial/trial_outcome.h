#pragma once

#include <string_view>

namespace assay::execution {

// The outcome of executing a plan, a plan tree, or the strategy of a mating.
enum class TrialOutcome {
  kSucceeded,  // the execution came to its end; of a judged trial: and every goal holds

  // The execution was not completed.
  kUnreachable,     // the arm cannot follow a way that the plan asks for
  kOverload,        // the wrist felt more force than allowed, and the arm stopped
  kTooHeavy,        // the arm's motors cannot carry the weight of the arm and of what it holds
  kEngineWarning,   // the engine's numbers cannot be trusted, so the trial proves nothing
  kNotFound,        // a sensor did not see the part that it was to find
  kOperatorCalled,  // a person takes over: the plan says so, or no recovery mended an error

  // A mating was not completed, as far as the arm can detect it. A plan then calls a person.
  kJammed,        // the part stopped short of its end, and is free without the push
  kWedged,        // the part stopped short of its end, and cannot be drawn back either
  kWrongContact,  // something touched that should not touch
  kTimeout,       // the contact that should end a motion did not come
  kDropped,       // the part is no longer in the hand

  // A tree was not walked to a leaf.
  kStopped,    // a skill could not be done
  kUncertain,  // sensing left a branch open
  kEndless,    // the walk reached no leaf within its greatest number of actions

  // A judged trial came to its end and failed.
  kFalseClaim,   // something that a tree claimed to know was false, even if the goal is true
  kCollided,     // an arm touched something, or a hand or a held part touched what it must not
  kGraspFailed,  // a goal does not hold, and before that a grasp had failed
  kNotSeated,    // a held part is not all the way in
  kMisaligned,   // a held part is in, but off to the side, tilted or turned
  kNotLocated,   // a part does not rest in a stable pose that a goal names
  kNotReleased,  // a part is still in the hand
  kNotAtRest,    // a part still moves
  kSpilled,      // a part was tilted further than is allowed
  kFallen,       // a part does not rest in the stable pose of the start
  kMissed,       // the goal of a tree is not true
};
std::string_view Name(TrialOutcome outcome);  // "grasp-failed"
// Returns the name of the end of an execution that is not judged: "done" if it succeeded.
std::string_view NameOfEnd(TrialOutcome outcome);

}  // namespace assay::execution
