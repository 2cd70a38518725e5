#include "planner/contingent/language/term_types.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "planner/base/input_files/nearest_name.h"

namespace assay::contingent {

void TermTypes::Fail(Place place, const std::string& what, const std::string& allowed) const {
  throw InputError({file_, place.line, place.column}, what, allowed);
}

void TermTypes::FailUnknown(Place place, const std::string& kind, const std::string& name,
                            const std::vector<std::string>& known) const {
  const std::string nearest = NearestName(name, known);
  Fail(place,
       nearest.empty() ? fmt::format("unknown {} '{}'", kind, name)
                       : fmt::format("unknown {} '{}', did you mean '{}'?", kind, name, nearest),
       known.empty() ? "nothing" : fmt::format("{}", fmt::join(known, ", ")));
}

Scope TermTypes::Extended(const Scope& outer, const std::vector<TypedName>& variables) const {
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

bool TermTypes::IsNumeric(const Literal& literal) const {
  return literal.relation != Relation::kPredicate && literal.relation != Relation::kExtern &&
         IsNumeric(literal.arguments.front());
}

bool TermTypes::IsNumeric(const Term& term) const {
  if (term.kind == Term::Kind::kFunction) {
    const Symbol* const function = symbols_.FindFunction(term.name);
    return function != nullptr && function->range == kNumberType;
  }
  return term.kind != Term::Kind::kConstant && term.kind != Term::Kind::kVariable;
}

void TermTypes::FailCount(const Symbol& symbol, std::size_t count, Place place) const {
  Fail(place, fmt::format("'{}' has {} arguments here", symbol.name, count),
       fmt::format("{}, as declared", symbol.parameters.size()));
}

void TermTypes::CheckArguments(const Symbol& symbol, std::vector<Term>& arguments, Place place,
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

const TypedName* TermTypes::FindVariable(const std::string& name, const Scope& scope) const {
  const auto found = std::find_if(scope.rbegin(), scope.rend(),
                                  [&](const TypedName& v) { return v.name == name; });
  return found != scope.rend() ? &*found : nullptr;
}

std::string TermTypes::TypeOf(Term& term, const Scope& scope) {
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

std::string TermTypes::TypeOfVariable(const Term& term, const Scope& scope) const {
  const TypedName* const variable = FindVariable(term.name, scope);
  if (variable) return variable->type;
  std::vector<std::string> known;
  for (const TypedName& in_scope : scope) known.push_back("?" + in_scope.name);
  FailUnknown(term.place, "variable", "?" + term.name, known);
}

std::string TermTypes::TypeOfFunction(Term& term, const Scope& scope) {
  const Symbol* const function = symbols_.FindFunction(term.name);
  if (!function) FailUnknown(term.place, "function", term.name, symbols_.FunctionNames());
  CheckArguments(*function, term.arguments, term.place, scope);
  return function->range;
}

}  // namespace assay::contingent
