#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "planner/contingent/language/symbol_table.h"

namespace assay::contingent {

using Scope = std::vector<TypedName>;  // visible variables; the last one of a name counts

// Finds and checks the types of terms in one file. All errors are InputErrors with the term's
// place.
class TermTypes {
 public:
  TermTypes(const SymbolTable& symbols, const std::string& file)  // keeps references
      : symbols_(symbols), file_(file) {}

  const SymbolTable& symbols() const { return symbols_; }

  // Returns the type of a term: of its value if it is a function. A constant that is the name of a
  // function without arguments becomes a function.
  std::string TypeOf(Term& term, const Scope& scope);
  // Checks the arguments of a predicate, function or extern against its declaration.
  void CheckArguments(const Symbol& symbol, std::vector<Term>& arguments, Place place,
                      const Scope& scope);
  // Return whether a literal compares numbers, and whether a term is a number.
  bool IsNumeric(const Literal& literal) const;
  bool IsNumeric(const Term& term) const;

  // Returns the scope with more variables, which must have names of their own and known types.
  Scope Extended(const Scope& outer, const std::vector<TypedName>& variables) const;
  // Returns the variable of this name, or null if the scope has none.
  const TypedName* FindVariable(const std::string& name, const Scope& scope) const;

  [[noreturn]] void Fail(Place place, const std::string& what, const std::string& allowed) const;
  [[noreturn]] void FailUnknown(Place place, const std::string& kind, const std::string& name,
                                const std::vector<std::string>& known) const;
  [[noreturn]] void FailCount(const Symbol& symbol, std::size_t count, Place place) const;

 private:
  std::string TypeOfVariable(const Term& term, const Scope& scope) const;
  std::string TypeOfFunction(Term& term, const Scope& scope);

  const SymbolTable& symbols_;
  const std::string& file_;
};

}  // namespace assay::contingent
