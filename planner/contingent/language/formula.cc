#include "planner/contingent/language/formula.h"

#include <utility>

namespace assay::contingent {
namespace {

Query Joined(Query::Kind kind, std::vector<Query> operands) {
  if (operands.size() == 1) return std::move(operands.front());
  return {.kind = kind, .operands = std::move(operands)};
}

}  // namespace

Term Constant(const std::string& name) { return {.name = name}; }
Term NumberTerm(const Interval& value) { return {.kind = Term::Kind::kNumber, .value = value}; }
Term Of(const std::string& function, const std::string& argument) {
  return {.kind = Term::Kind::kFunction, .name = function, .arguments = {Constant(argument)}};
}

Literal Atom(const std::string& predicate, const std::vector<std::string>& arguments) {
  Literal literal = {.predicate = predicate};
  for (const std::string& argument : arguments) literal.arguments.push_back(Constant(argument));
  return literal;
}

Literal Not(Literal literal) {
  literal.is_positive = !literal.is_positive;
  return literal;
}

Literal Equal(const Term& a, const Term& b) {
  return {.relation = Relation::kEqual, .arguments = {a, b}};
}

Query Known(const Literal& literal) { return {.kind = Query::Kind::kKnown, .literals = {literal}}; }

Query ValueKnown(const Term& term, double within) {
  return {.kind = Query::Kind::kValueKnown, .terms = {term}, .within = within};
}

Query All(std::vector<Query> operands) { return Joined(Query::Kind::kAnd, std::move(operands)); }
Query Any(std::vector<Query> operands) { return Joined(Query::Kind::kOr, std::move(operands)); }

Change Know(const Literal& fact) { return {.literals = {fact}}; }
Change KnowWhether(const Literal& fact) { return {.store = Store::kWhether, .literals = {fact}}; }
Change KnowOneOf(std::vector<Literal> alternatives) {
  return {.store = Store::kExclusive, .literals = std::move(alternatives)};
}
Change KnowValue(const Term& term, std::optional<double> within) {
  return {.store = Store::kValues, .terms = {term}, .within = within};
}
Change Forget(const Literal& fact) { return {.is_addition = false, .literals = {fact}}; }

}  // namespace assay::contingent
