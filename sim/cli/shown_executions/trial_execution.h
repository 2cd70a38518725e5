#pragma once

#include <string>

#include "sim/check/trial_verdicts/trial.h"
#include "sim/cli/shown_executions/shown_execution.h"

namespace assay::cli {

// These functions return a trial as it is shown. The trial must have samples. `source` and
// `plan_file` are as in view::Subject.

// A trial without noise, in this scene.
ShownExecution NoiselessExecution(const check::Experiment& experiment, check::Trial trial,
                                  const std::string& source, const std::string& plan_file);
// A trial under noise. The experiment's scene is the one without errors.
ShownExecution TrialExecution(const check::Experiment& experiment, check::Trial trial,
                              const std::string& source, const std::string& plan_file);

}  // namespace assay::cli
