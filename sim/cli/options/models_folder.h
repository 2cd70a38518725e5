#pragma once

#include <CLI/CLI.hpp>

#include "planner/domain/workcell/model_path.h"

namespace assay::cli {

// The option --models of a verb, which may be given more than once. `models` outlives the command.
void AddModelsOption(CLI::App& command, domain::ModelPath& models);

// For verbs without an input file: the folders given, then the one that belongs to the working
// directory, else the one that was installed. Throws EnvironmentError if there is none.
domain::ModelPath FindModelsHere(const domain::ModelPath& given);

}  // namespace assay::cli
