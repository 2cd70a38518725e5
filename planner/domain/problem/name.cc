#include "planner/domain/problem/name.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

namespace assay::domain {

std::string ReadName(const Value& key, std::string_view what) {
  const std::string name = key.Text();
  const bool good = !name.empty() && std::ranges::all_of(name, [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_';
  });
  if (!good) key.Fail(fmt::format("'{}' cannot name {}", name, what), "letters, digits, - and _");
  return name;
}

std::string ReadAnyName(const Value& value) {
  std::string name = value.Text();
  if (name.empty()) value.Fail("the name is empty", "a name");
  return name;
}

}  // namespace assay::domain
