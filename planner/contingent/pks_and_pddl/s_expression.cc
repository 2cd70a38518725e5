#include "planner/contingent/pks_and_pddl/s_expression.h"

#include <fmt/format.h>

#include "planner/base/input_files/quotation.h"

namespace assay::contingent {
namespace {

class SExpressionReader {
 public:
  SExpressionReader(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  SExpression ReadAll() {
    SkipBlanks();
    if (at_ == text_.size() || text_[at_] != '(') Fail("no list here", "one list in parentheses");
    SExpression all = Read(0);
    SkipBlanks();
    // Some published problems have one closing parenthesis too many at the end.
    while (at_ < text_.size() && text_[at_] == ')') {
      Advance();
      SkipBlanks();
    }
    if (at_ < text_.size()) Fail("something follows the list", "one list in parentheses");
    return all;
  }

 private:
  [[noreturn]] void Fail(const std::string& what, const std::string& allowed) const {
    throw InputError({file_, here_.line, here_.column}, what, allowed);
  }

  void Advance() {
    here_ = text_[at_] == '\n' ? Place{here_.line + 1, 1} : Place{here_.line, here_.column + 1};
    ++at_;
  }

  static bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

  void SkipBlanks() {
    while (at_ < text_.size() && (IsBlank(text_[at_]) || text_[at_] == ';')) {
      const bool is_comment = text_[at_] == ';';
      Advance();
      while (is_comment && at_ < text_.size() && text_[at_] != '\n') Advance();
    }
  }

  SExpression Read(int depth) {
    if (depth > kDeepestNesting) {
      Fail("nested too deeply", fmt::format("{} levels", kDeepestNesting));
    }
    SExpression read;
    read.place = here_;
    if (text_[at_] != '(') {
      while (at_ < text_.size() && !IsBlank(text_[at_]) && text_[at_] != '(' && text_[at_] != ')' &&
             text_[at_] != ';') {
        const char c = text_[at_];
        read.word += 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        Advance();
      }
      if (read.word.size() > kLongestWord) {
        here_ = read.place;
        Fail(fmt::format("{} has {} characters", Quote(read.word), read.word.size()),
             fmt::format("words of {} characters", kLongestWord));
      }
      return read;
    }
    read.is_list = true;
    Advance();
    for (SkipBlanks(); at_ < text_.size() && text_[at_] != ')'; SkipBlanks()) {
      read.items.push_back(Read(depth + 1));
    }
    if (at_ == text_.size()) Fail("the file ends here", "')'");
    Advance();
    return read;
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0;
  Place here_{1, 1};
};

}  // namespace

SExpression ReadSExpression(std::string_view text, const std::string& file) {
  return SExpressionReader(text, file).ReadAll();
}

}  // namespace assay::contingent
