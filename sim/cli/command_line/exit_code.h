#pragma once

#include <string>

#include "planner/base/outcome.h"

namespace assay::cli {

// The program's exit codes. A broken invariant of the program itself ends it by SIGABRT instead.
enum class ExitCode {
  kDone = 0,
  kWrongCommandLine = 2,
  kWrongInput = 3,
  kEnvironment = 4,
  kNoPlan = 10,
  kBudgetSpent = 11,
  kFailed = 12,
  kInterrupted = 130,
  kTerminated = 143,
};

ExitCode ExitCodeOf(Outcome outcome);

// Returns all codes with their meanings, one on each line, for the help.
std::string ExitCodeTable();

}  // namespace assay::cli
