#include "planner/budget/quantity_group.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace assay::budget {
namespace {

std::vector<std::string> NamesIn(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  const std::string coordinates = dot == std::string::npos ? "" : name.substr(dot + 1);
  if (coordinates.empty() || coordinates.find_first_not_of("xyz") != std::string::npos)
    return {name};
  std::vector<std::string> names;
  for (const char coordinate : coordinates) names.push_back(name.substr(0, dot + 1) + coordinate);
  return names;
}

}  // namespace

std::optional<QuantityGroup> FindGroup(const std::string& name,
                                       const std::vector<ErrorQuantity>& quantities) {
  QuantityGroup group = {name, {}};
  for (const std::string& of : NamesIn(name)) {
    const auto quantity = std::ranges::find(quantities, of, &ErrorQuantity::name);
    if (quantity == quantities.end()) return std::nullopt;
    group.quantities.push_back(static_cast<std::size_t>(quantity - quantities.begin()));
  }
  return group;
}

std::string NamesOf(const std::vector<ErrorQuantity>& quantities) {
  std::vector<std::string> names;
  for (const ErrorQuantity& quantity : quantities) names.push_back(quantity.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace assay::budget
