#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "sim/cli/tasks/planned_problem.h"
#include "sim/execution/trace/trace.h"

namespace assay::cli {

// Reads a trace of an execution of the plan. `text` is the contents of `file`. Throws InputError if
// it is no trace, or one of another plan.
execution::Trace ReadTraceOf(const PlannedProblem& planned, std::string_view text,
                             const std::filesystem::path& file);

}  // namespace assay::cli
