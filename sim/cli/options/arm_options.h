#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <vector>

#include "planner/kinematics/arm.h"

namespace assay::cli {

// An arm in a URDF file, as the user names it.
struct ArmOptions {
  kinematics::ArmInFile arm;                    // names of links may be empty
  std::vector<std::filesystem::path> packages;  // folders with packages of meshes
};

// Adds the options --base, --flange and --packages to a verb. `options` must outlive the command.
void AddArmOptions(CLI::App& command, ArmOptions& options);

}  // namespace assay::cli
