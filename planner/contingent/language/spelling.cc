#include "planner/contingent/language/spelling.h"

#include <fmt/format.h>

namespace assay::contingent {

std::string Spelled(std::string_view text) {
  std::string name;
  for (const char c : text) {
    const bool is_digit = '0' <= c && c <= '9';
    if (('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || is_digit || c == '_') {
      if (name.empty() && is_digit) name = '_';
      name += c;
    } else if (!name.empty() && name.back() != '-') {
      name += '-';
    }
  }
  if (name.ends_with('-')) name.pop_back();
  return name.empty() ? "_" : name;
}

std::string Unique(const std::string& name, std::set<std::string>& taken) {
  std::string unique = name;
  for (int n = 2; !taken.insert(unique).second; ++n) unique = fmt::format("{}-{}", name, n);
  return unique;
}

}  // namespace assay::contingent
