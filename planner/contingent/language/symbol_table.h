#pragma once

#include <map>
#include <string>
#include <vector>

#include "planner/contingent/language/domain.h"

namespace assay::contingent {

// The declarations of a domain and a problem, by name.
class SymbolTable {
 public:
  // Throws InputError at a name that is declared twice, and at a type that is not declared.
  SymbolTable(const Domain& domain, const Problem& problem);

  const Symbol* FindPredicate(const std::string& name) const { return Find(predicates_, name); }
  const Symbol* FindFunction(const std::string& name) const { return Find(functions_, name); }
  const Symbol* FindExtern(const std::string& name) const { return Find(externs_, name); }
  const TypedName* FindConstant(const std::string& name) const { return Find(constants_, name); }
  bool HasType(const std::string& name) const { return parents_.contains(name); }

  // Returns true if every object of type `type` is an object of type `ancestor`. The empty type ""
  // is the type of all objects.
  bool IsA(std::string type, const std::string& ancestor) const;
  // Returns the constants of the type, in the order of their declarations.
  const std::vector<std::string>& ConstantsOf(const std::string& type) const;

  std::vector<std::string> PredicateNames() const;
  std::vector<std::string> FunctionNames() const;
  std::vector<std::string> ExternNames() const;
  std::vector<std::string> ConstantNames() const;
  std::vector<std::string> TypeNames() const;

 private:
  template <class T>
  static const T* Find(const std::map<std::string, const T*>& names, const std::string& name) {
    const auto found = names.find(name);
    return found != names.end() ? found->second : nullptr;
  }

  void DeclareTypes(const Domain& domain);
  void DeclareSymbols(const std::string& file, const std::vector<Symbol>& symbols,
                      std::map<std::string, const Symbol*>& to);
  void DeclareConstants(const std::string& file, const std::vector<TypedName>& constants);
  static void RequireOwnNames(const Domain& domain);
  void RequireType(const std::string& file, const std::string& type, Place place) const;

  std::map<std::string, std::string> parents_;  // the parent of each type
  std::map<std::string, const Symbol*> predicates_;
  std::map<std::string, const Symbol*> functions_;
  std::map<std::string, const Symbol*> externs_;
  std::map<std::string, const TypedName*> constants_;
  mutable std::map<std::string, std::vector<std::string>> constants_of_;
  std::vector<const TypedName*> constants_in_order_;
};

}  // namespace assay::contingent
