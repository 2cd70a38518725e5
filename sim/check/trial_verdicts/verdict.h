#pragma once

#include <string>
#include <vector>

#include "planner/plan/data/plan.h"
#include "sim/execution/trace/trace.h"
#include "sim/execution/trial/finding.h"
#include "sim/execution/trial/trial_outcome.h"

namespace assay::check {

using execution::TrialOutcome;

// The judgement on a trial by the true poses in the simulator.
struct Verdict {
  TrialOutcome outcome = TrialOutcome::kSucceeded;
  std::string reason = {};                        // step, predicate, values; empty if succeeded
  std::vector<execution::Finding> findings = {};  // of all goals, whether they hold or not
};

// Judges an execution by its trace. If there are several reasons for failure, the outcome is the
// first of them in the order of the enumeration. The findings list all of them.
Verdict Judge(const domain::Problem& problem, const execution::Trace& trace,
              const execution::Limits& limits);

}  // namespace assay::check
