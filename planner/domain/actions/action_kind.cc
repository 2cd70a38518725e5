#include "planner/domain/actions/action_kind.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace assay::domain {

bool ActionKind::Has(Argument argument) const {
  return std::ranges::count(arguments, argument) > 0;
}

bool ActionKind::Needs(Need need) const { return std::ranges::count(needs, need) > 0; }

std::string Text(const ActionKind& kind, std::span<const Argument> arguments,
                 const std::function<std::string(Argument)>& text_of) {
  if (arguments.empty()) return std::string(kind.name);
  std::vector<std::string> texts;
  for (const Argument argument : arguments) texts.push_back(text_of(argument));
  return fmt::format("{}({})", kind.name, fmt::join(texts, ", "));
}

}  // namespace assay::domain
