#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "planner/plan/data/plan.h"
#include "sim/check/trial/predicate.h"
#include "sim/execution/trace/trace.h"

namespace assay::check {

// The outcome of a trial, judged by the true poses in the simulator.
enum class TrialOutcome {
  kSucceeded,       // every goal holds
  kUnreachable,     // the arm cannot follow a way that the plan asks for
  kOverload,        // the wrist felt more force than allowed, and the arm stopped
  kEngineWarning,   // the engine's numbers cannot be trusted, so the trial proves nothing
  kNotFound,        // a sensor did not see the part that it was to find
  kOperatorCalled,  // an error was signalled, and no recovery mended it
  kCollided,        // an arm touched something, or a hand touched what it does not handle
  kGraspFailed,     // a goal does not hold, and before that a grasp had failed
  kNotSeated,       // a held part is not all the way in
  kMisaligned,      // a held part is in, but off to the side, tilted or turned
  kNotLocated,      // a part does not rest in a stable pose that a goal names
  kNotReleased,     // a part is still in the hand
  kNotAtRest,       // a part still moves
};
std::string_view Name(TrialOutcome outcome);  // "grasp-failed"

struct Verdict {
  TrialOutcome outcome = TrialOutcome::kSucceeded;
  std::string reason = {};             // step, predicate, values; empty if succeeded
  std::vector<Finding> findings = {};  // of all goals, whether they hold or not
};

// Judges an execution by its trace. If there are several reasons for failure, the outcome is the
// first of them in the order of the enumeration. The findings list all of them.
Verdict Judge(const domain::Problem& problem, const execution::Trace& trace, const Limits& limits);

}  // namespace assay::check
