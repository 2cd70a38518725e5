#pragma once

#include <filesystem>

namespace assay::scenario {

// The folder with parts/, robots/ and workcells/ that a scenario file is read with: the nearest
// `models` beside the file or above it, else the one that was installed with this program
// (../share/assay/models from the executable). Throws InputError if there is none.
std::filesystem::path FindModels(const std::filesystem::path& scenario_file);

// Throws InputError unless the folder has workcells in it.
std::filesystem::path RequireModels(const std::filesystem::path& folder);

}  // namespace assay::scenario
