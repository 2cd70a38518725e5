#pragma once

#include <string>

#include "planner/domain/workcell/model_path.h"

namespace assay::sweep {

// For the shell, as one word, in quotes.
std::string Quoted(const std::string& text);
// The same, without quotes where it needs none.
std::string Word(const std::string& text);
// " --models FOLDER" for each folder, in this order.
std::string ModelsOption(const domain::ModelPath& models);

}  // namespace assay::sweep
