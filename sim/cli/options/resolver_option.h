#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/domain/workcell/uncertainty_operations.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace assay::cli {

// Adds the option --resolvers sensing,squeezing,fine-motion, which replaces the scenario's
// resolvers.
CLI::Option* AddResolvers(CLI::App& command, std::vector<std::string>& names);

// Returns the named resolvers, or nothing if `names` is empty and the scenario decides.
std::optional<std::vector<domain::ResolverKind>> ResolversFrom(
    const std::vector<std::string>& names);

}  // namespace assay::cli
