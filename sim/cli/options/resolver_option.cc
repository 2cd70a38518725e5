#include "sim/cli/options/resolver_option.h"

#include <CLI/CLI.hpp>
#include <algorithm>

namespace assay::cli {

CLI::Option* AddResolvers(CLI::App& command, std::vector<std::string>& names) {
  return command
      .add_option("--resolvers", names,
                  "ways in which the planner may reduce uncertainty, with commas between them, "
                  "instead of those in the scenario")
      ->delimiter(',')
      ->type_name("NAME")
      ->check(CLI::IsMember(domain::ResolverNames()));
}

std::optional<std::vector<domain::ResolverKind>> ResolversFrom(
    const std::vector<std::string>& names) {
  if (names.empty()) return std::nullopt;
  std::vector<domain::ResolverKind> kinds;
  const std::vector<std::string>& all = domain::ResolverNames();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (std::ranges::count(names, all[i]) > 0) {
      kinds.push_back(static_cast<domain::ResolverKind>(i));
    }
  }
  return kinds;
}

}  // namespace assay::cli
