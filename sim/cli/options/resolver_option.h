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

// --resolvers sensing,squeezing,fine-motion: which to use instead of those that the scenario names.
CLI::Option* AddResolvers(CLI::App& command, std::vector<std::string>& names);

// None: as the scenario says.
std::optional<std::vector<domain::ResolverKind>> ResolversFrom(
    const std::vector<std::string>& names);

}  // namespace assay::cli
