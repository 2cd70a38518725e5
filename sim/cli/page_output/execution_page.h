#pragma once

#include <string>

#include "sim/cli/shown_executions/shown_execution.h"

namespace assay::cli {

// Returns the page of an execution (view::Page). If it is a trial under noise, the plan is executed
// once more without noise, and shown beside the trial.
std::string ExecutionPage(const ShownExecution& shown);

}  // namespace assay::cli
