#pragma once

#include <algorithm>
#include <string_view>

namespace assay::algebra {

inline bool IsDigit(char c) { return '0' <= c && c <= '9'; }
inline bool IsLetter(char c) {
  return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || c == '_';
}

// Returns true if the text is a valid variable name: a letter or _, followed by letters, digits and
// _.
inline bool IsName(std::string_view text) {
  return !text.empty() && IsLetter(text[0]) &&
         std::ranges::all_of(text, [](char c) { return IsLetter(c) || IsDigit(c); });
}

}  // namespace assay::algebra
