#include "planner/base/input_files/text_words.h"

#include <charconv>
#include <cmath>

#include "planner/base/input_files/input_error.h"
#include "planner/base/input_files/quotation.h"

namespace assay {
namespace {

constexpr double kGreatest = 1e6;
constexpr std::string_view kSpaces = " \t\r\v\f";

}  // namespace

bool TextWords::NextLine() {
  if (rest_.empty()) {
    current_ = {};
    return false;
  }
  const std::size_t end = rest_.find('\n');
  whole_ = current_ = rest_.substr(0, end);
  column_ = 1;
  rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
  ++line_;
  return true;
}

std::string_view TextWords::Word() {
  const std::size_t begin = current_.find_first_not_of(kSpaces);
  if (begin == std::string_view::npos) return {};
  column_ = static_cast<int>(current_.data() - whole_.data()) + static_cast<int>(begin) + 1;
  const std::size_t end = current_.find_first_of(kSpaces, begin);
  const std::string_view word = current_.substr(begin, end - begin);
  current_ = end == std::string_view::npos ? std::string_view() : current_.substr(end);
  return word;
}

std::string_view TextWords::WordOfAnyLine() {
  for (;;) {
    const std::string_view word = Word();
    if (!word.empty() || !NextLine()) return word;
  }
}

double TextWords::Number() {
  const std::string_view word = Word();
  const std::string_view digits = word.substr(word.starts_with('+') ? 1 : 0);
  double number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const bool is_number = !digits.empty() && end == digits.data() + digits.size() &&
                         (error == std::errc() || error == std::errc::result_out_of_range);
  if (!is_number || !(std::abs(number) <= kGreatest))
    Fail(Quote(word) + " is no coordinate", "a number of at most a million");
  return number;
}

void TextWords::Fail(const std::string& what, const std::string& allowed) const {
  throw InputError({file_, line_, column_}, what, allowed);
}

}  // namespace assay
