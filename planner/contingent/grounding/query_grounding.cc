#include "planner/contingent/grounding/query_grounding.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "planner/contingent/grounding/ground_query.h"

namespace assay::contingent {
namespace {

// Puts the formula in canonical form: "q & p & p" becomes "p & q", and "!p" becomes "p", because
// the truth of p is known if and only if the truth of !p is known.
void Canonicalize(Formula& formula) {
  std::vector<GroundLiteral>& literals = formula.literals;
  std::ranges::sort(literals, {},
                    [](const GroundLiteral& l) { return std::tuple(l.atom, l.is_positive); });
  literals.erase(std::unique(literals.begin(), literals.end()), literals.end());
  if (literals.size() == 1) literals.front().is_positive = true;
}

}  // namespace

GroundQuery QueryGrounding::QueryOf(const Query& query, Bindings bindings) {
  std::vector<GroundQuery> parts;
  switch (query.kind) {
    case Query::Kind::kKnown:
      for (const Literal& literal : query.literals) {
        parts.push_back(KnownLiteral(literal, bindings));
      }
      return Joined(GroundQuery::Kind::kAnd, std::move(parts));
    case Query::Kind::kKnownWhether:
      return KnownWhether(query, bindings);
    case Query::Kind::kValueKnown:
      return ValueKnown(terms_.FunctionOf(query.terms.front(), bindings), query.within);
    case Query::Kind::kNot:
      return Negated(QueryOf(query.operands.front(), bindings));
    case Query::Kind::kAnd:
    case Query::Kind::kOr:
      for (const Query& operand : query.operands) parts.push_back(QueryOf(operand, bindings));
      break;
    case Query::Kind::kForAll:
    case Query::Kind::kExists:
      terms_.ForEachBinding(query.variables, bindings, 0,
                            [&] { parts.push_back(QueryOf(query.operands.front(), bindings)); });
      break;
  }
  const bool is_and = query.kind == Query::Kind::kAnd || query.kind == Query::Kind::kForAll;
  return Joined(is_and ? GroundQuery::Kind::kAnd : GroundQuery::Kind::kOr, std::move(parts));
}

// Kw(a) holds if K(a) or K(!a) does. The query states these cases, so that the relaxed graph uses
// them.
GroundQuery QueryGrounding::KnownWhether(const Query& query, const Bindings& bindings) {
  std::vector<GroundQuery> all;
  std::vector<GroundQuery> ways;
  for (const Literal& literal : query.literals) {
    all.push_back(KnownLiteral(literal, bindings));
    Literal negation = literal;
    negation.is_positive = !literal.is_positive;
    ways.push_back(KnownLiteral(negation, bindings));
  }
  ways.push_back(Joined(GroundQuery::Kind::kAnd, std::move(all)));
  const auto formula = FormulaOf(query.literals, bindings);
  if (!formula) return ConstantQuery(!terms_.is_refused());
  GroundQuery whether;
  whether.kind = GroundQuery::Kind::kKnownWhether;
  whether.formula = *formula;
  ways.push_back(std::move(whether));
  return Joined(GroundQuery::Kind::kOr, std::move(ways));
}

GroundQuery QueryGrounding::ValueKnown(FunctionId function, std::optional<double> within) {
  std::vector<GroundQuery> ways(1);
  ways.front().kind = GroundQuery::Kind::kValueSensed;
  ways.front().function = function;
  ways.front().within = within;
  for (const AtomId value : terms_.task().functions[function.index()].values) {
    ways.push_back(Known({value, true}));
  }
  return Joined(GroundQuery::Kind::kOr, std::move(ways));
}

GroundQuery QueryGrounding::KnownLiteral(const Literal& literal, const Bindings& bindings) {
  switch (literal.relation) {
    case Relation::kPredicate:
      return KnownAtom(literal, bindings);
    case Relation::kExtern: {
      const std::vector<std::string> arguments = terms_.Constants(literal.arguments, bindings);
      if (terms_.is_refused()) return ConstantQuery(false);
      return ConstantQuery(externs_.Call(literal.predicate, arguments,
                                         terms_.PlaceOf(literal.place)) == literal.is_positive);
    }
    case Relation::kEqual:
      return KnownEqual(literal, bindings);
    case Relation::kLess:
    case Relation::kLessOrEqual:
    case Relation::kGreater:
    case Relation::kGreaterOrEqual:
      return BoundKnown(terms_.BoundOf(literal, bindings));
  }
  return {};
}

GroundQuery QueryGrounding::KnownAtom(const Literal& literal, const Bindings& bindings) {
  const std::vector<std::string> arguments = terms_.Constants(literal.arguments, bindings);
  if (terms_.is_refused()) return ConstantQuery(false);
  const Knowledge knowledge = terms_.table().AlwaysKnown(literal.predicate, arguments);
  if (knowledge != Knowledge::kUnknown) {
    return ConstantQuery((knowledge == Knowledge::kTrue) == literal.is_positive);
  }
  return Known({terms_.table().Atom(literal.predicate, arguments), literal.is_positive});
}

GroundQuery QueryGrounding::KnownEqual(const Literal& literal, const Bindings& bindings) {
  const GroundValue left = terms_.ValueOf(literal.arguments[0], bindings);
  const GroundValue right = terms_.ValueOf(literal.arguments[1], bindings);
  if (left.function.IsNone() && right.function.IsNone()) {
    return ConstantQuery((left.text == right.text) == literal.is_positive);
  }
  if (!left.function.IsNone() && !right.function.IsNone()) {
    return FunctionsEqual(left.function, right.function, literal.is_positive);
  }
  const bool is_left = !left.function.IsNone();
  const AtomId atom = terms_.table().Value(is_left ? left.function : right.function,
                                           is_left ? right.text : left.text);
  return atom.IsNone() ? ConstantQuery(!literal.is_positive) : Known({atom, literal.is_positive});
}

GroundQuery QueryGrounding::FunctionsEqual(FunctionId f, FunctionId g, bool is_positive) {
  if (f == g) return is_positive ? ValueKnown(f) : ConstantQuery(false);
  std::vector<GroundQuery> ways;
  for (const std::string& constant : terms_.task().functions[f.index()].constants) {
    const AtomId of_g = terms_.table().Value(g, constant);
    if (of_g.IsNone()) continue;
    const AtomId of_f = terms_.table().Value(f, constant);
    // Two functions differ if there is a constant that is known to be the value of one function,
    // and known not to be the value of the other.
    ways.push_back(
        Joined(GroundQuery::Kind::kAnd, {Known({of_f, true}), Known({of_g, is_positive})}));
    if (!is_positive) {
      ways.push_back(Joined(GroundQuery::Kind::kAnd, {Known({of_f, false}), Known({of_g, true})}));
    }
  }
  return Joined(GroundQuery::Kind::kOr, std::move(ways));
}

std::optional<FormulaId> QueryGrounding::FormulaOf(const std::vector<Literal>& literals,
                                                   const Bindings& bindings) {
  Formula formula;
  for (const Literal& literal : literals) {
    const GroundQuery known = KnownLiteral(literal, bindings);
    if (known.IsFalse() && !terms_.is_refused()) return std::nullopt;
    if (known.kind == GroundQuery::Kind::kBoundKnown) formula.bound = known.bound;
    if (known.kind == GroundQuery::Kind::kKnown) formula.literals.push_back(known.literal);
  }
  Canonicalize(formula);
  const bool says_nothing = formula.literals.empty() && !formula.bound;
  if (says_nothing || NeverHolds(formula)) return std::nullopt;
  return terms_.table().IdOf(formula);
}

// Two values of one function exclude each other, as an atom and its negation do.
bool QueryGrounding::NeverHolds(const Formula& formula) const {
  const auto exclude = [&](const GroundLiteral& a, const GroundLiteral& b) {
    if (a.atom == b.atom) return a.is_positive != b.is_positive;
    const FunctionId function = terms_.task().function_of_atom[a.atom.index()];
    return a.is_positive && b.is_positive && !function.IsNone() &&
           function == terms_.task().function_of_atom[b.atom.index()];
  };
  return std::ranges::any_of(formula.literals, [&](const GroundLiteral& a) {
    return std::ranges::any_of(formula.literals,
                               [&](const GroundLiteral& b) { return exclude(a, b); });
  });
}

}  // namespace assay::contingent
