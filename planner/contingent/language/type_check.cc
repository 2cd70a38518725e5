#include "planner/contingent/language/type_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "planner/contingent/language/term_types.h"

namespace assay::contingent {
namespace {

class Checker : private TermTypes {
 public:
  using TermTypes::TermTypes;

  void CheckAction(Action& action) {
    const Scope scope = Extended({}, action.parameters);
    CheckQuery(action.precondition, scope);
    for (Effect& effect : action.effects) CheckEffect(effect, scope);
  }

  void CheckEffect(Effect& effect, const Scope& outer) {
    const Scope scope = Extended(outer, effect.variables);
    CheckQuery(effect.condition, scope);
    for (Change& change : effect.changes) CheckChange(change, scope);
  }

  void CheckChange(Change& change, const Scope& scope) {
    switch (change.store) {
      case Store::kFacts:
        CheckFact(change, scope);
        return;
      case Store::kWhether:
        CheckConjunction(change.literals, scope);
        return;
      case Store::kValues:
        for (Term& term : change.terms) CheckValue(term, change.within.has_value(), scope);
        return;
      case Store::kExclusive:
        for (Literal& literal : change.literals) CheckObjectLiteral(literal, scope);
        return;
      case Store::kClosed:
        CheckClosed(change, scope);
        return;
    }
  }

  void CheckQuery(Query& query, const Scope& outer) {
    const Scope scope = Extended(outer, query.variables);
    if (query.kind == Query::Kind::kKnown) {
      for (Literal& literal : query.literals) CheckAsked(literal, scope);
    }
    if (query.kind == Query::Kind::kKnownWhether) CheckConjunction(query.literals, scope);
    for (Term& term : query.terms) CheckValue(term, query.within.has_value(), scope);
    for (Query& operand : query.operands) CheckQuery(operand, scope);
  }

  void CheckLiteral(Literal& literal, const Scope& scope) {
    switch (literal.relation) {
      case Relation::kPredicate:
        CheckArguments(PredicateOf(literal), literal.arguments, literal.place, scope);
        return;
      case Relation::kExtern: {
        const Symbol* const symbol = symbols().FindExtern(literal.predicate);
        if (!symbol)
          FailUnknown(literal.place, "extern", literal.predicate, symbols().ExternNames());
        CheckArguments(*symbol, literal.arguments, literal.place, scope);
        return;
      }
      case Relation::kEqual:
      case Relation::kLess:
      case Relation::kLessOrEqual:
      case Relation::kGreater:
      case Relation::kGreaterOrEqual:
        CheckComparison(literal, scope);
        return;
    }
  }

 private:
  // A conjunction is either one comparison of numbers or any number of literals about objects.
  void CheckConjunction(std::vector<Literal>& literals, const Scope& scope) {
    for (Literal& literal : literals) {
      CheckAsked(literal, scope);
      if (literal.relation == Relation::kExtern) {
        Fail(literal.place, "an extern is always known, so Kw does not apply to it",
             "a literal about the world");
      }
      if (IsNumeric(literal) && literals.size() > 1) {
        Fail(literal.place, "a comparison of numbers in a conjunction", "a comparison alone");
      }
    }
  }

  void CheckAsked(Literal& literal, const Scope& scope) {
    CheckLiteral(literal, scope);
    if (!IsNumeric(literal)) return;
    const Term& bound = literal.arguments[1];
    if (bound.kind != Term::Kind::kNumber || literal.relation == Relation::kEqual ||
        bound.value.low != bound.value.high) {
      Fail(bound.place, "not a bound", "f(...) <, <=, > or >= and a number");
    }
  }

  void CheckFact(Change& change, const Scope& scope) {
    Literal& literal = change.literals.front();
    CheckLiteral(literal, scope);
    if (literal.relation == Relation::kExtern) {
      Fail(literal.place, "an extern cannot be changed", "a literal about the world");
    }
    RequireFunction(literal);
    if (!change.is_addition && IsNumeric(literal) && literal.relation != Relation::kEqual) {
      Fail(literal.place, "a comparison cannot be deleted", "del(Kf, f = ...)");
    }
  }

  void CheckObjectLiteral(Literal& literal, const Scope& scope) {
    CheckLiteral(literal, scope);
    if (literal.relation == Relation::kExtern || IsNumeric(literal)) {
      Fail(literal.place, "not a literal about objects", "predicates and f(...) = object");
    }
    RequireFunction(literal);
  }

  // Rejects an equality of two names, which is no fact that could change.
  void RequireFunction(const Literal& literal) const {
    const bool has_function =
        std::any_of(literal.arguments.begin(), literal.arguments.end(),
                    [](const Term& t) { return t.kind == Term::Kind::kFunction; });
    if (literal.relation == Relation::kEqual && !has_function) {
      Fail(literal.place, "no function", "f(...) = constant");
    }
  }

  void CheckClosed(Change& change, const Scope& scope) {
    Literal& literal = change.literals.front();
    if (literal.relation != Relation::kPredicate || !literal.is_positive) {
      Fail(literal.place, "LCW of something else than a predicate", "add(LCW, p(?x, c))");
    }
    const Symbol& predicate = PredicateOf(literal);
    for (std::size_t i = 0; i < literal.arguments.size(); ++i) {
      const Term& term = literal.arguments[i];
      if (term.kind != Term::Kind::kVariable || FindVariable(term.name, scope) ||
          FindVariable(term.name, change.variables)) {
        continue;
      }
      change.variables.push_back(
          {.name = term.name, .type = predicate.parameters[i].type, .place = term.place});
    }
    CheckLiteral(literal, Extended(scope, change.variables));
  }

  const Symbol& PredicateOf(const Literal& literal) const {
    const Symbol* const symbol = symbols().FindPredicate(literal.predicate);
    if (!symbol) {
      FailUnknown(literal.place, "predicate", literal.predicate, symbols().PredicateNames());
    }
    if (symbol->parameters.size() != literal.arguments.size()) {
      FailCount(*symbol, literal.arguments.size(), literal.place);
    }
    return *symbol;
  }

  void CheckComparison(Literal& literal, const Scope& scope) {
    Term& left = literal.arguments[0];
    Term& right = literal.arguments[1];
    const std::string left_type = TypeOf(left, scope);
    const std::string right_type = TypeOf(right, scope);
    const bool is_numeric = left_type == kNumberType || right_type == kNumberType;
    if (is_numeric && left_type != right_type) {
      Fail(literal.place, "a number is compared with an object", "two numbers, or two objects");
    }
    if (is_numeric && left.kind != Term::Kind::kFunction) {
      Fail(left.place, "the left side of a comparison of numbers is no function",
           "f(...), one of the functions with values of type number");
    }
    if (!is_numeric && literal.relation != Relation::kEqual) {
      Fail(literal.place, "objects have no order", "= and !=");
    }
    if (is_numeric && !literal.is_positive && literal.relation == Relation::kEqual) {
      Fail(literal.place, "an interval has no !=", "=, <, <=, > and >=");
    }
    if (!is_numeric) CheckSides(left, left_type, right, right_type);
  }

  // Checks that a function's value is compared with a name whose type the value may have.
  void CheckSides(const Term& left, const std::string& left_type, const Term& right,
                  const std::string& right_type) const {
    const bool is_left = left.kind == Term::Kind::kFunction;
    if (is_left && right.kind == Term::Kind::kFunction) {
      Fail(right.place, fmt::format("'{}' is a function, as is the other side", right.name),
           "a constant or a ?variable on one side");
    }
    if (symbols().IsA(left_type, right_type) || symbols().IsA(right_type, left_type)) return;
    const bool is_declared = is_left || right.kind == Term::Kind::kFunction;
    const Term& side = is_left || !is_declared ? right : left;
    const Term& other = &side == &left ? right : left;
    Fail(side.place,
         fmt::format("'{}{}' is of type '{}'", side.kind == Term::Kind::kVariable ? "?" : "",
                     side.name, &side == &left ? left_type : right_type),
         fmt::format("'{}', as {}", &side == &left ? right_type : left_type,
                     is_declared ? fmt::format("'{}' is declared", other.name)
                                 : std::string("the other side")));
  }

  void CheckValue(Term& term, bool has_error, const Scope& scope) {
    const std::string type = TypeOf(term, scope);
    if (term.kind != Term::Kind::kFunction) {
      Fail(term.place, "not a function",
           fmt::format("a term of {}", fmt::join(symbols().FunctionNames(), ", ")));
    }
    if (has_error && type != kNumberType) {
      Fail(term.place, "'within' needs a numeric function", "a function of type number");
    }
  }
};

}  // namespace

void CheckTypes(Domain& domain, Problem& problem, const SymbolTable& symbols) {
  Checker in_domain(symbols, domain.file);
  for (Action& action : domain.actions) in_domain.CheckAction(action);
  for (Effect& update : domain.updates) in_domain.CheckEffect(update, {});
  Checker in_problem(symbols, problem.file);
  for (Literal& fact : problem.extern_facts) in_problem.CheckLiteral(fact, {});
  for (Change& change : problem.init) in_problem.CheckChange(change, {});
  in_problem.CheckQuery(problem.goal, {});
}

}  // namespace assay::contingent
