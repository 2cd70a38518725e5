#pragma once

#include <filesystem>

#include "planner/domain/workcell/model_path.h"

namespace assay::scenario {

// Where the models of a scenario file are looked for: in the given folders, each of which has parts
// or workcells in it; then in the nearest `models` with workcells beside the file or above it, else
// in the one that was installed with this program (../share/assay/models from the executable), else
// in the nearest one above the program.
// Throws InputError for a given folder that has neither, or if no folder has workcells.
domain::ModelPath FindModels(const std::filesystem::path& scenario_file,
                             const domain::ModelPath& given = {});

}  // namespace assay::scenario
