#pragma once

#include <optional>
#include <vector>

#include "sim/execution/trace/trace.h"

namespace assay::check {

// The events of one step in a trace. A pointer is null, or a flag false, if the event did not
// happen.
struct StepEvents {
  plan::StepId step;
  // Snapshot at the moment when the step before ended, or when the execution started.
  const execution::Snapshot* begun = nullptr;
  const execution::Snapshot* poised = nullptr;  // snapshot before the first attempt
  // Snapshot at the moment when, in the first attempt, the tool has come to where it acts.
  const execution::Snapshot* reached = nullptr;
  // Snapshot at the moment when, in the first attempt, the gripper or the sensor has acted.
  const execution::Snapshot* acted = nullptr;
  const execution::Snapshot* end = nullptr;
  // Snapshot at the moment when the execution broke off before the step's end.
  const execution::Snapshot* stopped = nullptr;
  const execution::LookRecord* look = nullptr;
  std::optional<bool> resisted = {};  // whether the first attempt's guarded move met resistance
  bool recovered = false;             // the step was tried more than once
};

// Returns the events of all steps that were begun, in the order of execution.
std::vector<StepEvents> EventsByStep(const execution::Trace& trace);

}  // namespace assay::check
