#pragma once

#include <string>

#include "sim/cli/shown_executions/shown_execution.h"
#include "sim/execution/trial/tree_trial.h"

namespace assay::cli {

// Returns a trial of a plan tree as it is shown. The trial must have samples. `source` is as in
// view::Subject. `file` names the scenario file in error messages. The exit code is kFailed if the
// trial failed.
ShownExecution TreeTrialExecution(const execution::KnowledgeScenario& scenario,
                                  const contingent::PlanTree& tree, execution::TreeTrial trial,
                                  const std::string& source, const std::string& file);

}  // namespace assay::cli
