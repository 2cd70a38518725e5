#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace assay {

// How texts of files are quoted in messages: on one line, without control characters, cut.

inline constexpr std::size_t kQuotedCharacters = 60;  // of the offending text in a message

struct CodePoint {
  char32_t value = 0;
  std::size_t bytes = 0;  // 0: the bytes are not UTF-8
};

// The first code point of a text that is not empty, by RFC 3629: no overlong forms, no surrogates.
CodePoint Decode(std::string_view text);

bool IsControl(char32_t c);

// At most `limit` characters of the text, on one line.
std::string Show(std::string_view text, std::size_t limit);
// At most kQuotedCharacters of it, between quotes.
std::string Quote(std::string_view text);

}  // namespace assay
