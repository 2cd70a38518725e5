#pragma once

#include <filesystem>

#include "planner/domain/workcell/model_path.h"

namespace assay::scenario {

// Returns the folders with the models of a scenario file. The given folders come first; each must
// have parts or workcells in it. Then comes the usual folder. It is the nearest `models` with
// workcells, beside the file or above it. If there is none, it is the folder installed with this
// program (share/assay/models in a folder above the program or above the Python module), or else
// the nearest one above that file. Throws InputError for a given folder that has neither parts nor
// workcells, or if no folder has workcells.
domain::ModelPath FindModels(const std::filesystem::path& scenario_file,
                             const domain::ModelPath& given = {});

}  // namespace assay::scenario
