#pragma once

#include <optional>
#include <vector>

#include "sim/exec/execution/trace.h"

namespace assay::check {

// What a trace says of one step. Null, or false: it did not come to that.
struct StepEvents {
  plan::StepId step;
  const exec::Moment* poised = nullptr;   // before the first attempt
  const exec::Moment* reached = nullptr;  // of the first attempt
  const exec::Moment* acted = nullptr;    // likewise
  const exec::Moment* end = nullptr;
  const exec::Moment* stopped = nullptr;  // where the execution broke off before the step's end
  const exec::LookRecord* look = nullptr;
  std::optional<bool> resisted = {};  // of the first attempt's guarded move
  bool recovered = false;             // it was tried more than once
};

// Of the steps that were begun, in the order of execution.
std::vector<StepEvents> EventsByStep(const exec::Trace& trace);

}  // namespace assay::check
