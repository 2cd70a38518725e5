#pragma once

#include <optional>
#include <string>

namespace assay::report {

// Returns the command with which a reader of the report runs a trial of its database again.
std::string ReplayCommand(const std::string& database, int trial);

// Returns the command with which a reader of the report views a trial in three dimensions, or a
// counterexample of a falsification. Counterexamples are numbered from 1.
std::string ViewCommand(const std::string& database, int trial,
                        std::optional<int> counterexample = std::nullopt);

// Returns a stored command with the database's path in place of the word DB.
std::string WithDatabase(const std::string& command, const std::string& database);

}  // namespace assay::report
