#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace assay {

// The one place that makes texts from outside (of files, databases, the command line, libraries)
// fit to be printed: control characters and what is not UTF-8 become visible (\x1b), so that no
// text moves a terminal's cursor or looks like a line of ours, and long texts are cut. Showing what
// is shown already changes nothing.

inline constexpr std::size_t kQuotedCharacters = 60;     // of the offending text in a message
inline constexpr std::size_t kMessageCharacters = 2000;  // of a message, or a part of it

struct CodePoint {
  char32_t value = 0;
  std::size_t bytes = 0;  // 0: the bytes are not UTF-8
};

// The first code point of a text that is not empty, by RFC 3629: no overlong forms, no surrogates.
CodePoint Decode(std::string_view text);

bool IsControl(char32_t c);
// A control character, or one that changes the order or place of what stands around it.
bool Disturbs(char32_t c);

// At most `limit` characters of the text, on one line.
std::string Show(std::string_view text, std::size_t limit = kMessageCharacters);
// At most kQuotedCharacters of it, between quotes.
std::string Quote(std::string_view text);
// All of it; line breaks and tabs stay.
std::string ShowLines(std::string_view text);

}  // namespace assay
