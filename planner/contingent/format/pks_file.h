#pragma once

#include <filesystem>
#include <string>

#include "planner/contingent/language/domain.h"

namespace assay::contingent {

// Read a PKS domain or problem in the format of scenarios/know/README.md. Only the form is checked
// here: that names are declared and types agree is CheckTypes (type_check.h). Throw InputError with
// file, line and column, and with what is allowed there.
Domain ReadPksDomain(const std::string& text, const std::string& file);
Problem ReadPksProblem(const std::string& text, const std::string& file);

// The whole file. Throws InputError if it cannot be read.
std::string TextOfFile(const std::filesystem::path& file);

}  // namespace assay::contingent
