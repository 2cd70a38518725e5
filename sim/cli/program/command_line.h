#pragma once

#include <string>
#include <vector>

#include "sim/cli/program/exit_code.h"

namespace assay::cli {

// The whole program: reads the arguments (the first is the program's own name), executes the verb,
// and turns what is thrown into a line on standard error and an exit code.
ExitCode RunCommandLine(const std::vector<std::string>& arguments);

}  // namespace assay::cli
