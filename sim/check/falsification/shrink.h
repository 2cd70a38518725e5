#pragma once

#include "sim/check/falsification/falsification_result.h"

namespace assay::check {

// The greatest number of steps that are executed to simplify one violation. A violation of a late
// step is therefore replayed less often than one of the first step.
inline constexpr int kMostStepsReplayed = 160;

// Makes a violation as simple as possible. The plan is executed again and again from its start up
// to the step in question, as long as kMostStepsReplayed allows. Errors are left out, many at once where that
// is possible, as long as the claim stays violated; the rest are made smaller together. `example`
// is the violation as it was found. At all times it is the simplest one so far, also if an
// execution throws Stopped (planner/base/stop.h).
void Shrink(const Experiment& experiment, Counterexample& example);

}  // namespace assay::check
