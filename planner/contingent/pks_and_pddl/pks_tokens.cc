#include "planner/contingent/pks_and_pddl/pks_tokens.h"

#include <fmt/format.h>

#include <algorithm>

namespace assay::contingent {

const Token& PksTokens::Peek(std::size_t ahead) const {
  return tokens_[std::min(at_ + ahead, tokens_.size() - 1)];
}

Token PksTokens::Take() { return at_ + 1 < tokens_.size() ? tokens_[at_++] : tokens_.back(); }

bool PksTokens::TakeIf(std::string_view sign) {
  const bool is_there = Peek().Is(sign);
  if (is_there) Take();
  return is_there;
}

bool PksTokens::TakeWordIf(std::string_view word) {
  const bool is_there = Peek().IsName(word);
  if (is_there) Take();
  return is_there;
}

bool PksTokens::TakeNegation() { return TakeIf("!") || TakeIf("-") || TakeWordIf("not"); }

void PksTokens::Expect(std::string_view sign) {
  if (!TakeIf(sign)) FailAtNext(fmt::format("'{}'", sign));
}

Token PksTokens::ExpectName(const std::string& what) {
  if (Peek().kind != Token::Kind::kName) FailAtNext(what);
  return Take();
}

bool PksTokens::BeginsSection() const {
  return Peek().kind == Token::Kind::kEnd || Peek().IsName("action") ||
         (Peek().kind == Token::Kind::kName && Peek(1).Is(":"));
}

bool PksTokens::IsSectionName() const {
  return Peek().kind == Token::Kind::kName && std::ranges::count(kPksSections, Peek().text) > 0;
}

std::vector<TypedName> PksTokens::TypedNames(Token::Kind kind) {
  std::vector<TypedName> names;
  std::size_t untyped = 0;
  while (Peek().kind == kind && !(IsSectionName() && Peek(1).Is(":"))) {
    const Token name = Take();
    names.push_back({.name = name.text, .type = "", .place = name.place});
    if (TakeIf(":")) {
      const std::string type = ExpectName("a type").text;
      for (; untyped < names.size(); ++untyped) names[untyped].type = type;
    }
    if (TakeIf(";")) {
      untyped = names.size();
    } else if (!TakeIf(",")) {
      break;
    }
  }
  return names;
}

std::vector<TypedName> PksTokens::Variables() {
  Expect("(");
  std::vector<TypedName> variables = TypedNames(Token::Kind::kVariable);
  Expect(")");
  return variables;
}

void PksTokens::FailAtNext(const std::string& allowed) const {
  const Token& next = Peek();
  Fail(next.place,
       next.kind == Token::Kind::kEnd ? "the file ends here"
                                      : fmt::format("unexpected '{}'", next.text),
       allowed);
}

void PksTokens::Fail(Place place, const std::string& what, const std::string& allowed) const {
  throw InputError({file_, place.line, place.column}, what, allowed);
}

PksTokens::Nesting::Nesting(PksTokens& tokens) : tokens_(tokens) {
  if (++tokens_.depth_ > kDeepestNesting) {
    tokens_.Fail(tokens_.Peek().place, "nested too deeply",
                 fmt::format("{} levels", kDeepestNesting));
  }
}

}  // namespace assay::contingent
