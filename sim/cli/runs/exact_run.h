#pragma once

#include <cstdint>
#include <filesystem>

#include "sim/cli/command_line/exit_code.h"
#include "sim/cli/picture_output/step_pictures.h"
#include "sim/cli/tasks/planned_problem.h"
#include "sim/sweep/shell_commands/run_command.h"

namespace assay::cli {

// Executions of one plan without noise: everything is where the problem says.
struct ExactRun {
  const PlannedProblem& planned;
  const sweep::RunCommand& command;  // the options that decide what the trials do
  std::filesystem::path folder;      // empty: nothing is written
  int trials = 1;
  int jobs = 1;  // threads
  std::uint64_t seed = 0;
  bool renders = false;  // pictures of the first trial
  PictureOptions pictures;
  bool json = false;
};

// Executes the trials and prints their report.
ExitCode RunExact(const ExactRun& run);

}  // namespace assay::cli
