#pragma once

#include <CLI/CLI.hpp>

#include "planner/domain/workcell/model_path.h"

namespace assay::cli {

// Adds the option --models to a verb; it may be given more than once. `models` must outlive the
// command.
void AddModelsOption(CLI::App& command, domain::ModelPath& models);

// Returns the model folders for a verb without an input file: the given ones, then the one that
// belongs to the working directory, or else the installed one. Throws EnvironmentError if there is
// none.
domain::ModelPath FindModelsHere(const domain::ModelPath& given);

}  // namespace assay::cli
