#pragma once

#include <filesystem>
#include <string>

#include "planner/contingent/language/domain.h"

namespace assay::contingent {

// ReadPksDomain and ReadPksProblem read the format of scenarios/know/README.md. These functions
// check only the form. CheckTypes (type_check.h) checks that names are declared and that types
// agree. The two functions throw InputError with file, line and column, and with the input that is
// allowed there.
Domain ReadPksDomain(const std::string& text, const std::string& file);
Problem ReadPksProblem(const std::string& text, const std::string& file);

// Returns the content of the whole file. Throws InputError if the file cannot be read.
std::string TextOfFile(const std::filesystem::path& file);

}  // namespace assay::contingent
