#include "planner/contingent/pks_and_pddl/pks_lexer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "planner/base/input_files/quotation.h"

namespace assay::contingent {
namespace {

bool IsDigit(char c) { return '0' <= c && c <= '9'; }
bool IsWordCharacter(char c) {
  return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || c == '_' || IsDigit(c);
}

// Signs of two characters come first, so that they are tried first.
constexpr std::array<std::string_view, 19> kSigns = {"=>", "!=", "<=", ">=", "(", ")", ",",
                                                     ":",  ";",  "&",  "|",  "!", "-", "+",
                                                     "=",  "<",  ">",  "[",  "]"};

class Lexer {
 public:
  Lexer(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  std::vector<Token> Run() {
    std::vector<Token> tokens;
    for (SkipBlanks(); at_ < text_.size(); SkipBlanks()) tokens.push_back(Next());
    tokens.push_back({.kind = Token::Kind::kEnd, .text = "", .place = here_});
    return tokens;
  }

 private:
  char Peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }

  void Advance(std::size_t count) {
    for (; count > 0; --count, ++at_) {
      const bool ends_line = text_[at_] == '\n';
      here_ = ends_line ? Place{here_.line + 1, 1} : Place{here_.line, here_.column + 1};
    }
  }

  void SkipBlanks() {
    while (at_ < text_.size()) {
      if (Peek() == '#') {
        while (at_ < text_.size() && Peek() != '\n') Advance(1);
      } else if (Peek() == ' ' || Peek() == '\t' || Peek() == '\n' || Peek() == '\r') {
        Advance(1);
      } else {
        return;
      }
    }
  }

  Token Next() {
    if (Peek() == '?' && IsWordCharacter(Peek(1))) {
      Token token = Take(Token::Kind::kVariable, 1 + WordLength(1));
      token.text.erase(0, 1);
      return token;
    }
    if (IsDigit(Peek())) return TakeNumberOrName();
    if (IsWordCharacter(Peek())) return Take(Token::Kind::kName, WordLength(0));
    for (const std::string_view sign : kSigns) {
      if (text_.substr(at_, sign.size()) == sign) return Take(Token::Kind::kSign, sign.size());
    }
    throw InputError({file_, here_.line, here_.column},
                     fmt::format("unknown character {}", Shown()),
                     "names, ?variables, numbers, and ( ) [ ] , : ; & | ! - + = != < <= > >= =>");
  }

  std::string Shown() const {
    const auto byte = static_cast<unsigned char>(Peek());
    return byte < 0x20 || byte >= 0x7F ? fmt::format("0x{:02x}", byte)
                                       : fmt::format("'{}'", Peek());
  }

  std::size_t WordLength(std::size_t from) const {
    std::size_t length = 0;
    while (IsWordCharacter(Peek(from + length)) ||
           (length > 0 && Peek(from + length) == '-' && IsWordCharacter(Peek(from + length + 1)))) {
      ++length;
    }
    return length;
  }

  std::size_t NumberLength() const {
    std::size_t length = 0;
    const auto digits = [&] {
      while (IsDigit(Peek(length))) ++length;
    };
    digits();
    if (Peek(length) == '.') {
      ++length;
      digits();
    }
    const std::size_t sign = Peek(length + 1) == '-' || Peek(length + 1) == '+' ? 2 : 1;
    if ((Peek(length) == 'e' || Peek(length) == 'E') && IsDigit(Peek(length + sign))) {
      length += sign;
      digits();
    }
    return length;
  }

  // Takes the longer of a number and a name: 2.5e-3 is a number, and 3rd-floor is a name.
  Token TakeNumberOrName() {
    const std::size_t number = NumberLength();
    const std::size_t word = WordLength(0);
    return number >= word ? Take(Token::Kind::kNumber, number) : Take(Token::Kind::kName, word);
  }

  Token Take(Token::Kind kind, std::size_t length) {
    Token token{kind, std::string(text_.substr(at_, length)), here_};
    if (length > kLongestWord) {
      throw InputError({file_, here_.line, here_.column},
                       fmt::format("{} has {} characters", Quote(token.text), length),
                       fmt::format("words of {} characters", kLongestWord));
    }
    Advance(length);
    return token;
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0;
  Place here_{1, 1};
};

}  // namespace

std::vector<Token> Tokens(std::string_view text, const std::string& file) {
  return Lexer(text, file).Run();
}

}  // namespace assay::contingent
