#pragma once

#include <string>

namespace assay::report {

// Returns the command that runs a trial of a database again.
std::string ReplayCommand(const std::string& database, int trial);

// Returns a stored command with the database's path in place of the word DB.
std::string WithDatabase(const std::string& command, const std::string& database);

}  // namespace assay::report
