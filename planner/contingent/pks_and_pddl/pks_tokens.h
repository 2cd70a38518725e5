#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "planner/contingent/pks_and_pddl/pks_lexer.h"

namespace assay::contingent {

// The tokens of a .pks text, taken one after the other. The readers of formulas, effects and
// sections (recursive descent, one function for each rule of the grammar) share one object. All
// errors are InputErrors with the token's place and the input that is allowed there.
class PksTokens {
 public:
  PksTokens(const std::string& text, const std::string& file)
      : file_(file), tokens_(Tokens(text, file)) {}

  const std::string& file() const { return file_; }

  // Returns the next token, or one further ahead. After the last token there are only kEnd tokens.
  const Token& Peek(std::size_t ahead = 0) const;
  Token Take();
  // Take the next token if it is this sign or this word, and return whether it is.
  bool TakeIf(std::string_view sign);
  bool TakeWordIf(std::string_view word);
  bool TakeNegation();  // a sign ! or -, or the word not
  void Expect(std::string_view sign);
  Token ExpectName(const std::string& what);

  // Returns whether a section or the end of the file comes next.
  bool BeginsSection() const;
  bool IsSectionName() const;  // one of kPksSections

  // Reads one or more items with a separator between them. `read` reads one item.
  template <class Read>
  auto List(std::string_view separator, const Read& read) {
    std::vector<decltype(read())> items;
    do {
      items.push_back(read());
    } while (TakeIf(separator));
    return items;
  }
  // names = { name { "," name } [ ":" type ] [ "," | ";" ] }: a type applies to all names before it
  // that have none yet. The names are tokens of this kind: kName or kVariable.
  std::vector<TypedName> TypedNames(Token::Kind kind);
  std::vector<TypedName> Variables();  // typed variables in parentheses

  [[noreturn]] void FailAtNext(const std::string& allowed) const;
  [[noreturn]] void Fail(Place place, const std::string& what, const std::string& allowed) const;

  // Counts how deeply rules are nested, so that no file overflows the stack.
  class Nesting {
   public:
    explicit Nesting(PksTokens& tokens);
    ~Nesting() { --tokens_.depth_; }
    Nesting(const Nesting&) = delete;
    Nesting& operator=(const Nesting&) = delete;

   private:
    PksTokens& tokens_;
  };

 private:
  std::string file_;
  std::vector<Token> tokens_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace assay::contingent
