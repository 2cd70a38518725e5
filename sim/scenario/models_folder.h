#pragma once

#include <filesystem>

#include "planner/domain/workcell/model_path.h"

namespace assay::scenario {

// Returns the folders with the models of a scenario file. The given folders come first; each must
// have parts or workcells in it. Then come the default folders: each `models` with parts beside the
// file and above it, up to the nearest with workcells. If none has workcells, ModelsOfTheProgram
// comes last. Throws InputError for a given folder that has neither parts nor workcells, or if no
// folder has workcells.
domain::ModelPath FindModels(const std::filesystem::path& scenario_file,
                             const domain::ModelPath& given = {});

// Returns the folder of models that is installed with this program (share/assay/models in a folder
// above the program or above the Python module), or else the nearest one above that file. It is
// empty if there is none.
std::filesystem::path ModelsOfTheProgram();

}  // namespace assay::scenario
