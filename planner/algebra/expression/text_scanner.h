#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "planner/base/input_files/input_error.h"

namespace assay::algebra {

// Tells whether the text stands in its file character by character on one line (kAsInFile). If so,
// errors name the column. Otherwise (escapes, a text folded from several lines) errors name the
// place of the whole text, and the number of the character within it.
enum class Layout { kAsInFile, kOther };

// Reads the numbers, names and characters of an expression's text from left to right. Failures are
// InputErrors that name the place.
class TextScanner {
 public:
  TextScanner(std::string_view text, const FilePlace& place, Layout layout)
      : text_(text), place_(place), layout_(layout) {}

  std::size_t at() const { return at_; }
  bool IsAtEnd() const { return at_ >= text_.size(); }

  void SkipSpace() {
    while (at_ < text_.size() && IsSpace(text_[at_])) ++at_;
  }
  // Returns the next character after white space, or 0 at the end.
  char Next() {
    SkipSpace();
    return IsAtEnd() ? '\0' : text_[at_];
  }
  bool IsNext(char c) { return Next() == c; }
  bool Take(char c) {
    if (!IsNext(c)) return false;
    ++at_;
    return true;
  }

  std::string_view TakeWord();
  // Takes a number. "N deg" is N * pi / 180.
  double TakeNumber();
  int TakeExponent();
  // Takes "#" and a place in a list of `count` shared expressions.
  std::size_t TakeSharedPlace(std::size_t count);

  [[noreturn]] void Fail(std::size_t at, const std::string& what, std::string_view allowed) const;
  // Reports that the text here is not what the grammar allows.
  [[noreturn]] void FailAtNext(std::string_view allowed) const;
  // Returns a character's place in words: "column 3" or "character 3".
  std::string PlaceText(std::size_t at) const;

 private:
  static bool IsSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
  std::string_view NextWord() const;
  bool ContinuesNumber() const;
  std::size_t EndOfDigits(std::size_t at) const;
  std::size_t EndOfNumber() const;

  std::string_view text_;
  const FilePlace& place_;
  Layout layout_;
  std::size_t at_ = 0;
};

inline constexpr std::string_view kOperandAllowed =
    "a number, a variable, a function or a parenthesis";

}  // namespace assay::algebra
