#include "planner/base/input_files/quotation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace assay {
namespace {

std::size_t Utf8Length(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead >> 5 == 0x06) return 2;
  if (lead >> 4 == 0x0e) return 3;
  if (lead >> 3 == 0x1e) return 4;
  return 0;
}

std::string Visible(char32_t control) {
  if (control == U'\n') return "\\n";
  if (control == U'\r') return "\\r";
  if (control == U'\t') return "\\t";
  return fmt::format("\\x{:02x}", static_cast<std::uint32_t>(control));
}

// Removes the first character of a non-empty text and returns it in its visible form.
std::string TakeShown(std::string_view& text) {
  const CodePoint c = Decode(text);
  const std::string_view bytes = text.substr(0, std::max<std::size_t>(c.bytes, 1));
  text.remove_prefix(bytes.size());
  if (c.bytes == 0) return Visible(static_cast<unsigned char>(bytes[0]));
  return Disturbs(c.value) ? Visible(c.value) : std::string(bytes);
}

}  // namespace

CodePoint Decode(std::string_view text) {
  constexpr std::array<char32_t, 5> kLeast = {0, 0, 0x80, 0x800, 0x10000};
  const auto lead = static_cast<unsigned char>(text[0]);
  const std::size_t bytes = Utf8Length(lead);
  if (bytes == 0 || bytes > text.size()) return {};
  char32_t value = bytes == 1 ? lead : lead & (0x7fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    const auto next = static_cast<unsigned char>(text[i]);
    if (next >> 6 != 0x02) return {};
    value = value << 6 | (next & 0x3fu);
  }
  const bool surrogate = value >= 0xd800 && value <= 0xdfff;
  if (value < kLeast[bytes] || surrogate || value > 0x10ffff) return {};
  return {.value = value, .bytes = bytes};
}

bool IsControl(char32_t c) { return c < 0x20 || (c >= 0x7f && c < 0xa0); }

bool Disturbs(char32_t c) {
  const bool is_direction =
      c == 0x200e || c == 0x200f || (c >= 0x202a && c <= 0x202e) || (c >= 0x2066 && c <= 0x2069);
  const bool is_line_break = c == 0x2028 || c == 0x2029;
  return IsControl(c) || is_direction || is_line_break;
}

std::string Show(std::string_view text, std::size_t limit) {
  std::string shown;
  for (std::size_t i = 0; i < limit && !text.empty(); ++i) shown += TakeShown(text);
  return text.empty() ? shown : shown + "...";
}

std::string Quote(std::string_view text) {
  return fmt::format("'{}'", Show(text, kQuotedCharacters));
}

std::string ShowLines(std::string_view text) {
  std::string shown;
  shown.reserve(text.size());
  const auto is_plain = [](char c) { return (c >= 0x20 && c < 0x7f) || c == '\n' || c == '\t'; };
  while (true) {
    const auto plain = std::ranges::find_if_not(text, is_plain) - text.begin();
    shown += text.substr(0, static_cast<std::size_t>(plain));
    text.remove_prefix(static_cast<std::size_t>(plain));
    if (text.empty()) return shown;
    shown += TakeShown(text);
  }
}

}  // namespace assay
