#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "planner/contingent/language/domain.h"

namespace assay::contingent {

struct Token {
  enum class Kind { kName, kVariable, kNumber, kSign, kEnd };
  Kind kind = Kind::kEnd;
  std::string text;  // of a variable without its question mark
  Place place;

  bool Is(std::string_view sign) const { return kind == Kind::kSign && text == sign; }
  bool IsName(std::string_view name) const { return kind == Kind::kName && text == name; }
};

// What sections and parts of actions begin with, before a colon. In a list of names one of these
// can not be the last one before its type.
inline constexpr std::array<std::string_view, 11> kPksSections = {
    "types",   "predicates", "functions", "externs",  "constants", "updates",
    "objects", "init",       "goal",      "preconds", "effects"};

// The tokens of a .pks text, the last one kEnd. A name is letters, digits, _ and, between two of
// these, -; a comment goes from # to the end of its line. Throws InputError at other characters.
std::vector<Token> Tokens(std::string_view text, const std::string& file);

}  // namespace assay::contingent
