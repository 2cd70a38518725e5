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
  std::string text;  // a variable's text lacks its question mark
  Place place;

  bool Is(std::string_view sign) const { return kind == Kind::kSign && text == sign; }
  bool IsName(std::string_view name) const { return kind == Kind::kName && text == name; }
};

// The words that begin a section or a part of an action, before a colon. In a list of names, none
// of these words can be the last name before a type.
inline constexpr std::array<std::string_view, 11> kPksSections = {
    "types",   "predicates", "functions", "externs",  "constants", "updates",
    "objects", "init",       "goal",      "preconds", "effects"};

// Returns the tokens of a .pks text; the last one is kEnd. A name consists of letters, digits, _
// and of - between two of these. A comment goes from # to the end of its line. Throws InputError at
// any other character.
std::vector<Token> Tokens(std::string_view text, const std::string& file);

}  // namespace assay::contingent
