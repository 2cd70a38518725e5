#pragma once

#include <string>
#include <vector>

#include "sim/cli/command_line/exit_code.h"

namespace assay::cli {

// Runs the whole program. Reads the arguments, of which the first is the program's own name,
// executes the verb, and turns an exception into a line on standard error and an exit code.
ExitCode RunCommandLine(const std::vector<std::string>& arguments);

}  // namespace assay::cli
