#pragma once

#include <string>

#include "planner/domain/workcell/model_path.h"

namespace assay::sweep {

// Returns the text as one quoted word for the shell.
std::string Quoted(const std::string& text);
// Returns the text as one word for the shell, without quotes if it needs none.
std::string Word(const std::string& text);
// Returns " --models FOLDER" for each folder, in the order of the path.
std::string ModelsOption(const domain::ModelPath& models);

}  // namespace assay::sweep
