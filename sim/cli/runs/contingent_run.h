#pragma once

#include <filesystem>
#include <optional>

#include "sim/cli/command_line/exit_code.h"
#include "sim/cli/picture_output/step_pictures.h"
#include "sim/sweep/shell_commands/run_command.h"

namespace assay::cli {

// The options of `assay run` that concern the execution of a plan tree.
struct ContingentRun {
  // The options that decide what the trials do. The scenario has a key `knowledge` or `goal`.
  const sweep::RunCommand& command;
  std::optional<int> trials;     // none: one, or with every leaf one trial for each leaf
  std::filesystem::path folder;  // empty: nothing is written
  int jobs = 1;
  bool renders = false;
  PictureOptions pictures;
  bool json = false;
};

// Plans a tree for the scenario, executes it in the simulator and audits what it claims to know.
ExitCode RunContingent(const ContingentRun& run);

}  // namespace assay::cli
