#include "planner/base/input_files/decimal_text.h"

#include <algorithm>
#include <cstddef>

namespace assay {
namespace {

std::size_t CountDigits(std::string_view text) {
  return std::min(text.find_first_not_of("0123456789"), text.size());
}

std::string_view SkipSign(std::string_view text) {
  if (!text.empty() && (text[0] == '+' || text[0] == '-')) text.remove_prefix(1);
  return text;
}

}  // namespace

bool IsInteger(std::string_view text) {
  text = SkipSign(text);
  return !text.empty() && CountDigits(text) == text.size();
}

bool IsDecimal(std::string_view text) {
  text = SkipSign(text);
  std::size_t digits = CountDigits(text);
  text.remove_prefix(digits);
  if (!text.empty() && text[0] == '.') {
    text.remove_prefix(1);
    const std::size_t fraction = CountDigits(text);
    digits += fraction;
    text.remove_prefix(fraction);
  }
  if (digits == 0) return false;
  return text.empty() || ((text[0] == 'e' || text[0] == 'E') && IsInteger(text.substr(1)));
}

}  // namespace assay
