#include "planner/contingent/language/formula.h"

#include <utility>

namespace assay::contingent {
namespace {

Query Joined(Query::Kind kind, std::vector<Query> operands) {
  if (operands.size() == 1) return std::move(operands.front());
  Query query;
  query.kind = kind;
  query.operands = std::move(operands);
  return query;
}

Change ChangeOf(Store store, std::vector<Literal> literals) {
  Change change;
  change.store = store;
  change.literals = std::move(literals);
  return change;
}

}  // namespace

Term Constant(const std::string& name) {
  Term term;
  term.name = name;
  return term;
}

Term NumberTerm(const Interval& value) {
  Term term;
  term.kind = Term::Kind::kNumber;
  term.value = value;
  return term;
}

Term Of(const std::string& function, const std::string& argument) {
  Term term;
  term.kind = Term::Kind::kFunction;
  term.name = function;
  term.arguments = {Constant(argument)};
  return term;
}

Literal Atom(const std::string& predicate, const std::vector<std::string>& arguments) {
  Literal literal;
  literal.predicate = predicate;
  for (const std::string& argument : arguments) literal.arguments.push_back(Constant(argument));
  return literal;
}

Literal Not(Literal literal) {
  literal.is_positive = !literal.is_positive;
  return literal;
}

Literal Equal(Term a, Term b) {
  Literal literal;
  literal.relation = Relation::kEqual;
  literal.arguments = {std::move(a), std::move(b)};
  return literal;
}

Query Known(Literal literal) {
  Query query;
  query.kind = Query::Kind::kKnown;
  query.literals = {std::move(literal)};
  return query;
}

Query ValueKnown(Term term, double within) {
  Query query;
  query.kind = Query::Kind::kValueKnown;
  query.terms = {std::move(term)};
  query.within = within;
  return query;
}

Query All(std::vector<Query> operands) { return Joined(Query::Kind::kAnd, std::move(operands)); }
Query Any(std::vector<Query> operands) { return Joined(Query::Kind::kOr, std::move(operands)); }

Change Know(Literal fact) { return ChangeOf(Store::kFacts, {std::move(fact)}); }
Change KnowWhether(Literal fact) { return ChangeOf(Store::kWhether, {std::move(fact)}); }
Change KnowOneOf(std::vector<Literal> alternatives) {
  return ChangeOf(Store::kExclusive, std::move(alternatives));
}
Change Forget(Literal fact) {
  Change change = Know(std::move(fact));
  change.is_addition = false;
  return change;
}
Change KnowValue(Term term, std::optional<double> within) {
  Change change;
  change.store = Store::kValues;
  change.terms = {std::move(term)};
  change.within = within;
  return change;
}

Symbol SymbolOf(const std::string& name, const std::vector<std::string>& types,
                const std::string& range) {
  Symbol symbol;
  symbol.name = name;
  for (const std::string& type : types) symbol.parameters.push_back({.name = "", .type = type});
  symbol.range = range;
  return symbol;
}

}  // namespace assay::contingent
