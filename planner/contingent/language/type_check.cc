#include "planner/contingent/language/type_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "planner/base/document/document.h"
#include "planner/base/document/nearest_name.h"

namespace assay::contingent {
namespace {

using Scope = std::vector<TypedName>;  // visible variables; the last one of a name counts

class Checker {
 public:
  Checker(const SymbolTable& symbols, const std::string& file) : symbols_(symbols), file_(file) {}

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
        const Symbol* const symbol = symbols_.FindExtern(literal.predicate);
        if (!symbol)
          FailUnknown(literal.place, "extern", literal.predicate, symbols_.ExternNames());
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
  [[noreturn]] void Fail(Place place, const std::string& what, const std::string& allowed) const {
    throw InputError({file_, place.line, place.column}, what, allowed);
  }

  [[noreturn]] void FailUnknown(Place place, const std::string& kind, const std::string& name,
                                const std::vector<std::string>& known) const {
    const std::string nearest = NearestName(name, known);
    Fail(place,
         nearest.empty() ? fmt::format("unknown {} '{}'", kind, name)
                         : fmt::format("unknown {} '{}', did you mean '{}'?", kind, name, nearest),
         known.empty() ? "nothing" : fmt::format("{}", fmt::join(known, ", ")));
  }

  Scope Extended(const Scope& outer, const std::vector<TypedName>& variables) const {
    Scope scope = outer;
    for (const TypedName& variable : variables) {
      const bool is_twice =
          std::any_of(scope.begin() + static_cast<std::ptrdiff_t>(outer.size()), scope.end(),
                      [&](const TypedName& before) { return before.name == variable.name; });
      if (is_twice) {
        Fail(variable.place, fmt::format("'?{}' is declared twice", variable.name),
             "a name of its own for each");
      }
      if (!variable.type.empty() && !symbols_.HasType(variable.type)) {
        FailUnknown(variable.place, "type", variable.type, symbols_.TypeNames());
      }
      scope.push_back(variable);
    }
    return scope;
  }

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

  bool IsNumeric(const Literal& literal) const {
    return literal.relation != Relation::kPredicate && literal.relation != Relation::kExtern &&
           IsNumeric(literal.arguments.front());
  }

  bool IsNumeric(const Term& term) const {
    if (term.kind == Term::Kind::kFunction) {
      const Symbol* const function = symbols_.FindFunction(term.name);
      return function != nullptr && function->range == kNumberType;
    }
    return term.kind != Term::Kind::kConstant && term.kind != Term::Kind::kVariable;
  }

  const Symbol& PredicateOf(const Literal& literal) const {
    const Symbol* const symbol = symbols_.FindPredicate(literal.predicate);
    if (!symbol) {
      FailUnknown(literal.place, "predicate", literal.predicate, symbols_.PredicateNames());
    }
    if (symbol->parameters.size() != literal.arguments.size()) {
      FailCount(*symbol, literal.arguments.size(), literal.place);
    }
    return *symbol;
  }

  [[noreturn]] void FailCount(const Symbol& symbol, std::size_t count, Place place) const {
    Fail(place, fmt::format("'{}' has {} arguments here", symbol.name, count),
         fmt::format("{}, as declared", symbol.parameters.size()));
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
    if (symbols_.IsA(left_type, right_type) || symbols_.IsA(right_type, left_type)) return;
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
           fmt::format("a term of {}", fmt::join(symbols_.FunctionNames(), ", ")));
    }
    if (has_error && type != kNumberType) {
      Fail(term.place, "'within' needs a numeric function", "a function of type number");
    }
  }

  void CheckArguments(const Symbol& symbol, std::vector<Term>& arguments, Place place,
                      const Scope& scope) {
    if (symbol.parameters.size() != arguments.size()) FailCount(symbol, arguments.size(), place);
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      const std::string type = TypeOf(arguments[i], scope);
      if (arguments[i].kind == Term::Kind::kFunction || type == kNumberType) {
        Fail(arguments[i].place, "a nested term", "a constant or a variable");
      }
      // A variable of a wider type is narrowed when it is bound (grounding.h).
      const std::string& wanted = symbol.parameters[i].type;
      if (!symbols_.IsA(type, wanted) && !symbols_.IsA(wanted, type)) {
        Fail(arguments[i].place, fmt::format("this is of type '{}'", type),
             fmt::format("'{}', as '{}' is declared", wanted, symbol.name));
      }
    }
  }

  const TypedName* FindVariable(const std::string& name, const Scope& scope) const {
    const auto found = std::find_if(scope.rbegin(), scope.rend(),
                                    [&](const TypedName& v) { return v.name == name; });
    return found != scope.rend() ? &*found : nullptr;
  }

  std::string TypeOf(Term& term, const Scope& scope) {
    switch (term.kind) {
      case Term::Kind::kVariable:
        return TypeOfVariable(term, scope);
      case Term::Kind::kConstant:
        if (const TypedName* constant = symbols_.FindConstant(term.name)) return constant->type;
        if (!symbols_.FindFunction(term.name)) {
          FailUnknown(term.place, "constant", term.name, symbols_.ConstantNames());
        }
        term.kind = Term::Kind::kFunction;
        [[fallthrough]];
      case Term::Kind::kFunction:
        return TypeOfFunction(term, scope);
      case Term::Kind::kNumber:
        return kNumberType;
      case Term::Kind::kSum:
      case Term::Kind::kDifference:
        for (Term& argument : term.arguments) {
          if (TypeOf(argument, scope) != kNumberType) {
            Fail(argument.place, "not a number", "numbers, intervals and functions of type number");
          }
        }
        return kNumberType;
    }
    return "";
  }

  std::string TypeOfVariable(const Term& term, const Scope& scope) const {
    const TypedName* const variable = FindVariable(term.name, scope);
    if (variable) return variable->type;
    std::vector<std::string> known;
    for (const TypedName& in_scope : scope) known.push_back("?" + in_scope.name);
    FailUnknown(term.place, "variable", "?" + term.name, known);
  }

  std::string TypeOfFunction(Term& term, const Scope& scope) {
    const Symbol* const function = symbols_.FindFunction(term.name);
    if (!function) FailUnknown(term.place, "function", term.name, symbols_.FunctionNames());
    CheckArguments(*function, term.arguments, term.place, scope);
    return function->range;
  }

  const SymbolTable& symbols_;
  const std::string& file_;
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
