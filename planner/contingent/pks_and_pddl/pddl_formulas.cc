#include "planner/contingent/pks_and_pddl/pddl_formulas.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace assay::contingent {
namespace {

// Returns true for PDDL keywords that this reader does not support at all, or only in some places.
bool IsKeyword(const std::string& word) {
  static constexpr std::array kWords = {
      "and",   "or",     "oneof",    "unknown",  "when",     "forall",       "exists",
      "imply", "assign", "increase", "decrease", "scale-up", "probabilistic"};
  return std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

}  // namespace

void PddlFormulas::Fail(const SExpression& at, const std::string& what,
                        const std::string& allowed) const {
  throw InputError({file_, at.place.line, at.place.column}, what, allowed);
}

PddlFormulas::Items PddlFormulas::Rest(const SExpression& list, std::size_t from) {
  return Items(list.items).subspan(std::min(from, list.items.size()));
}

const std::string& PddlFormulas::Word(const SExpression& e, const std::string& what) const {
  if (e.is_list) Fail(e, "a list", what);
  return e.word;
}

const SExpression& PddlFormulas::Only(const SExpression& list) const {
  if (list.items.size() != 2) {
    Fail(list, fmt::format("{} items", list.items.size()), "a word and one argument");
  }
  return list.items[1];
}

std::vector<TypedName> PddlFormulas::TypedNames(Items items) const {
  std::vector<TypedName> names;
  std::size_t untyped = 0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items[i].Is("-")) {
      if (++i == items.size()) Fail(items[i - 1], "nothing follows '-'", "a type");
      for (; untyped < names.size(); ++untyped) names[untyped].type = Word(items[i], "a type");
    } else {
      std::string name = Word(items[i], "a name");
      if (name.starts_with('?')) name.erase(0, 1);
      names.push_back({.name = std::move(name), .type = kPddlRootType, .place = items[i].place});
    }
  }
  return names;
}

Literal PddlFormulas::ReadLiteral(const SExpression& e, const std::string& allowed) const {
  if (e.BeginsWith("not")) {
    Literal literal = ReadLiteral(Only(e), allowed);
    literal.is_positive = !literal.is_positive;
    return literal;
  }
  if (e.items.empty()) Fail(e, "no literal", "(PREDICATE ...) or (not (PREDICATE ...))");
  Literal literal;
  literal.place = e.place;
  literal.predicate = Word(e.items[0], "a predicate");
  if (IsKeyword(literal.predicate)) {
    Fail(e,
         fmt::format("'{}' is a part of PDDL that this reader does not support", literal.predicate),
         allowed);
  }
  if (literal.predicate == "=") literal.relation = Relation::kEqual;
  for (const SExpression& item : Rest(e, 1)) {
    Term term;
    term.name = Word(item, "a constant or a ?variable");
    term.place = item.place;
    if (term.name.starts_with('?')) {
      term.kind = Term::Kind::kVariable;
      term.name.erase(0, 1);
    }
    literal.arguments.push_back(std::move(term));
  }
  if (literal.relation == Relation::kEqual && literal.arguments.size() != 2) {
    Fail(e, fmt::format("{} sides", literal.arguments.size()), "(= A B)");
  }
  return literal;
}

Query PddlFormulas::Condition(const SExpression& e, bool is_positive) const {
  Query query;
  query.place = e.place;
  if (e.BeginsWith("not")) return Condition(Only(e), !is_positive);
  if ((e.is_list && e.items.empty()) || e.BeginsWith("and") || e.BeginsWith("or")) {
    const bool is_and = !e.BeginsWith("or");
    query.kind = is_and == is_positive ? Query::Kind::kAnd : Query::Kind::kOr;
    for (const SExpression& item : Rest(e, 1)) {
      query.operands.push_back(Condition(item, is_positive));
    }
    return query;
  }
  query.kind = Query::Kind::kKnown;
  query.literals.push_back(ReadLiteral(e, "literals, and, or and not"));
  query.literals.front().is_positive = is_positive;
  return query;
}

}  // namespace assay::contingent
