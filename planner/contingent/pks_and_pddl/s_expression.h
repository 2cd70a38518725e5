#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "planner/contingent/language/domain.h"

namespace assay::contingent {

// A word, or a list in parentheses.
struct SExpression {
  bool is_list = false;
  std::string word;
  std::vector<SExpression> items;
  Place place;

  bool Is(std::string_view text) const { return !is_list && word == text; }
  // Returns true for a list that begins with the word `text`.
  bool BeginsWith(std::string_view text) const { return !items.empty() && items[0].Is(text); }
};

// Reads the text as one expression, in lower case and without comments (from ; to the end of the
// line). Throws InputError where parentheses do not match, and at more than 100 levels.
SExpression ReadSExpression(std::string_view text, const std::string& file);

}  // namespace assay::contingent
