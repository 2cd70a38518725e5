#pragma once

#include "sim/cli/shown_executions/shown_execution.h"

namespace CLI {
class App;
}

namespace assay::cli {

// Adds the input and the options that say what is shown: number, --counterexample, --worlds, --plan
// and --models.
void AddShowOptions(CLI::App& command, ShowRequest& request);

}  // namespace assay::cli
