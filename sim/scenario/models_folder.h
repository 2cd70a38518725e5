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
// above the program or above the Python module). If there is none, returns the nearest folder of
// models above the file of the program or module. If there is none either, the path is empty.
std::filesystem::path ModelsOfTheProgram();

}  // namespace assay::scenario
