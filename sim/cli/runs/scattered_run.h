#pragma once

#include <cstdint>
#include <filesystem>

#include "sim/cli/command_line/exit_code.h"
#include "sim/scenario/scenario.h"
#include "sim/sweep/shell_commands/run_command.h"

namespace assay::cli {

// The trials of `assay run --scatter`: one scenario with its parts at other places in each trial,
// each of which is planned anew.
struct ScatteredRun {
  const sweep::RunCommand& command;  // the options that decide what the trials do
  std::filesystem::path folder;      // empty: nothing is written
  int trials = 1;
  int jobs = 1;  // threads
  std::uint64_t seed = 0;
  bool json = false;
};

// Runs the trials and prints their report. Every trial draws from its own stream, so that its
// result does not depend on the others. A trial fails if it has no plan, or one that the
// independent checker refuses.
ExitCode RunScattered(const ScatteredRun& run, const scenario::Scenario& scenario);

}  // namespace assay::cli
