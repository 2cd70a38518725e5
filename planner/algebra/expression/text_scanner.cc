#include "planner/algebra/expression/text_scanner.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numbers>
#include <system_error>

#include "planner/algebra/expression/name.h"
#include "planner/base/check.h"

namespace assay::algebra {

namespace {

constexpr int kLargestWrittenExponent = 100;

}  // namespace

void TextScanner::Fail(std::size_t at, const std::string& what, std::string_view allowed) const {
  FilePlace place = place_;
  switch (layout_) {
    case Layout::kAsInFile:
      place.column += static_cast<int>(at);
      throw InputError(place, what, std::string(allowed));
    case Layout::kOther:
      throw InputError(place, fmt::format("{} of the expression: {}", PlaceText(at), what),
                       std::string(allowed));
  }
  ASSAY_CHECK(false, "no such layout");
}

std::string TextScanner::PlaceText(std::size_t at) const {
  return layout_ == Layout::kAsInFile
             ? fmt::format("column {}", place_.column + static_cast<int>(at))
             : fmt::format("character {}", at + 1);
}

void TextScanner::FailAtNext(std::string_view allowed) const {
  if (IsAtEnd()) Fail(at_, "the expression ends too early", allowed);
  Fail(at_, fmt::format("unexpected '{}' in an expression", NextWord()), allowed);
}

// Returns the name, number or character here.
std::string_view TextScanner::NextWord() const {
  std::size_t end = at_;
  while (end < text_.size() && (IsLetter(text_[end]) || IsDigit(text_[end]))) ++end;
  // A character beyond ASCII has several bytes.
  if (end == at_) ++end;
  while (end < text_.size() && (static_cast<unsigned char>(text_[end]) & 0xC0U) == 0x80U) ++end;
  return text_.substr(at_, end - at_);
}

std::string_view TextScanner::TakeWord() {
  const std::string_view word = NextWord();
  at_ += word.size();
  return word;
}

bool TextScanner::ContinuesNumber() const {
  return !IsAtEnd() && (text_[at_] == '.' || IsLetter(text_[at_]) || IsDigit(text_[at_]));
}

int TextScanner::TakeExponent() {
  const std::string allowed =
      fmt::format("an integer from -{} to {}", kLargestWrittenExponent, kLargestWrittenExponent);
  SkipSpace();
  const std::size_t begin = at_;
  int exponent = 0;
  const auto [end, error] =
      std::from_chars(text_.data() + at_, text_.data() + text_.size(), exponent);
  if (error == std::errc::invalid_argument) FailAtNext(allowed);
  at_ = static_cast<std::size_t>(end - text_.data());
  const bool is_small = error == std::errc() && std::abs(exponent) <= kLargestWrittenExponent;
  if (is_small && !ContinuesNumber()) return exponent;
  while (ContinuesNumber()) ++at_;
  Fail(begin, fmt::format("the exponent {}", text_.substr(begin, at_ - begin)), allowed);
}

std::size_t TextScanner::EndOfDigits(std::size_t at) const {
  while (at < text_.size() && IsDigit(text_[at])) ++at;
  return at;
}

std::size_t TextScanner::EndOfNumber() const {
  std::size_t end = EndOfDigits(at_);
  if (end < text_.size() && text_[end] == '.') end = EndOfDigits(end + 1);
  if (end < text_.size() && (text_[end] == 'e' || text_[end] == 'E')) {
    std::size_t digits = end + 1;
    if (digits < text_.size() && (text_[digits] == '+' || text_[digits] == '-')) ++digits;
    if (EndOfDigits(digits) > digits) end = EndOfDigits(digits);
  }
  return end;
}

double TextScanner::TakeNumber() {
  const std::size_t begin = at_;
  const std::string_view digits = text_.substr(begin, EndOfNumber() - begin);
  double value = 0;
  const auto error = std::from_chars(digits.data(), digits.data() + digits.size(), value).ec;
  if (error == std::errc::invalid_argument) FailAtNext(kOperandAllowed);
  if (error == std::errc::result_out_of_range) {
    Fail(begin, fmt::format("the number {}", digits), "a finite number that a double can hold");
  }
  at_ += digits.size();
  if (!IsLetter(Next())) return value;
  const std::string_view word = NextWord();
  if (word != "deg") {
    Fail(at_, fmt::format("'{}' follows the number {} without an operator", word, digits),
         fmt::format("{}*{}, or deg after a number", digits, word));
  }
  at_ += word.size();
  return value * std::numbers::pi / 180;
}

std::size_t TextScanner::TakeSharedPlace(std::size_t count) {
  const std::size_t begin = at_++;
  std::size_t place = 0;
  const std::size_t end = EndOfDigits(at_);
  const auto error = std::from_chars(text_.data() + at_, text_.data() + end, place).ec;
  if (error != std::errc() || place >= count) {
    Fail(begin, fmt::format("there is no shared expression {}", text_.substr(begin, end - begin)),
         fmt::format("# and a place of the {} shared expressions before this one, from 0", count));
  }
  at_ = end;
  return place;
}

}  // namespace assay::algebra
