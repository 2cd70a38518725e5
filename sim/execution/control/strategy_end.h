#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/execution/control/holding.h"
#include "sim/execution/trace/trace.h"

namespace assay::execution {

// A contact state that the plan does not have, or from which its motion cannot go on.
struct ErrorState {
  TrialOutcome outcome = TrialOutcome::kSucceeded;
  std::string reason = {};
  int motion = 0;  // index of the motion in which it occurred
  // The contact by which the error state was recognized; missing if the plan does not know this
  // error state.
  std::optional<RecognizedContact> recognized = {};
  double time = 0;  // when it occurred, simulated seconds
  // The way in which a stuck part is held by the contacts that the engine has at that time. Control
  // does not know these contacts.
  std::optional<Holding> holding = {};
};

struct StrategyEnd {
  TrialOutcome outcome = TrialOutcome::kSucceeded;
  std::string reason = {};                 // empty if the strategy is done
  int motion = 0;                          // index of the motion in which it ended
  std::vector<ErrorState> recovered = {};  // error states that the arm left again
  // Error states of the last attempt, in which the arm went on.
  std::vector<ErrorState> ignored = {};
  std::optional<RecognizedContact> recognized = {};
  double time = 0;  // when it ended, simulated seconds
  std::optional<Holding> holding = {};
};

}  // namespace assay::execution
