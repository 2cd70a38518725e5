#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "sim/cli/command_line/exit_code.h"
#include "sim/cli/tasks/planned_problem.h"
#include "sim/noise/sampling.h"
#include "sim/sweep/shell_commands/run_command.h"

namespace assay::cli {

// Executions of one plan under noise. Each certificate is compared with what truly happened.
struct NoisyRun {
  const PlannedProblem& planned;
  const sweep::RunCommand& command;          // the options that decide what the trials do
  std::filesystem::path folder;              // empty: nothing is written
  noise::Mode mode = noise::Mode::kUniform;  // of the errors, unless the command states them
  int trials = 1;
  int jobs = 1;  // threads
  std::uint64_t seed = 0;
  bool json = false;
};

// Executes the trials and prints their report.
ExitCode RunNoisy(const NoisyRun& run);

// Parses the errors of a command line (see noise::Text) for this plan. Throws UsageError.
noise::Noise NoiseFrom(const std::string& errors, const PlannedProblem& planned);

// A falsification of one plan (see sim/check/falsification/falsification.h).
struct FalsificationRun {
  const PlannedProblem& planned;
  const sweep::RunCommand& command;
  std::filesystem::path folder;
  std::int64_t attempts = 1000;
  int jobs = 1;
  std::uint64_t seed = 0;
  // If true, the run measures which multiple of the guaranteed noise breaks the plan.
  bool conservatism = false;
  bool json = false;
};

// Runs the falsification and prints its report.
ExitCode RunFalsification(const FalsificationRun& run);

}  // namespace assay::cli
