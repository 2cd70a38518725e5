#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace assay {

// These functions make external texts (from files, databases, the command line, libraries) fit to
// be printed; nothing else does. Control characters and bytes that are not UTF-8 become visible
// (\x1b), so that no text can move a terminal's cursor or imitate a line of the program. Long texts
// are cut. Showing a text that was already shown does not change it.

inline constexpr std::size_t kQuotedCharacters = 60;     // the most characters of a quoted text
inline constexpr std::size_t kMessageCharacters = 2000;  // the most characters of a message part

struct CodePoint {
  char32_t value = 0;
  std::size_t bytes = 0;  // 0 if the bytes are not UTF-8
};

// Returns the first code point of a non-empty text, by RFC 3629: no overlong forms, no surrogates.
CodePoint Decode(std::string_view text);

bool IsControl(char32_t c);
// Returns true for a control character, or one that changes the order or place of its neighbours.
bool Disturbs(char32_t c);

// Returns at most `limit` characters of the text, on one line.
std::string Show(std::string_view text, std::size_t limit = kMessageCharacters);
// Returns at most kQuotedCharacters characters of the text, between quotes.
std::string Quote(std::string_view text);
// Returns the whole text, with its line breaks and tabs.
std::string ShowLines(std::string_view text);

}  // namespace assay
