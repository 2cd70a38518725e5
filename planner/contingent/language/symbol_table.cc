#include "planner/contingent/language/symbol_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "planner/base/input_files/document.h"
#include "planner/base/input_files/nearest_name.h"

namespace assay::contingent {
namespace {

template <class T>
std::vector<std::string> Keys(const std::map<std::string, T>& names) {
  std::vector<std::string> keys;
  keys.reserve(names.size());
  for (const auto& [name, unused] : names) keys.push_back(name);
  return keys;
}

[[noreturn]] void FailTwice(const std::string& file, const std::string& name, Place place) {
  throw InputError({file, place.line, place.column}, fmt::format("'{}' is declared twice", name),
                   "a name of its own for each");
}

}  // namespace

SymbolTable::SymbolTable(const Domain& domain, const Problem& problem) {
  DeclareTypes(domain);
  DeclareSymbols(domain.file, domain.predicates, predicates_);
  DeclareSymbols(domain.file, domain.functions, functions_);
  DeclareSymbols(domain.file, domain.externs, externs_);
  DeclareConstants(domain.file, domain.constants);
  DeclareConstants(problem.file, problem.objects);
  RequireOwnNames(domain);
}

// Action names must differ, because a plan identifies an action by its name.
void SymbolTable::RequireOwnNames(const Domain& domain) {
  std::set<std::string> names;
  for (const Action& action : domain.actions) {
    if (!names.insert(action.name).second) FailTwice(domain.file, action.name, action.place);
  }
}

void SymbolTable::DeclareTypes(const Domain& domain) {
  for (const TypedName& type : domain.types) {
    if (!parents_.emplace(type.name, type.type).second || type.name == kNumberType) {
      FailTwice(domain.file, type.name, type.place);
    }
  }
  for (const TypedName& type : domain.types) {
    RequireType(domain.file, type.type, type.place);
    std::string above = type.type;
    for (std::size_t steps = 0; !above.empty(); above = parents_.at(above)) {
      if (++steps > parents_.size()) {
        throw InputError({domain.file, type.place.line, type.place.column},
                         fmt::format("type '{}' is its own ancestor", type.name),
                         "a tree of types");
      }
      RequireType(domain.file, above, type.place);
    }
  }
}

void SymbolTable::DeclareSymbols(const std::string& file, const std::vector<Symbol>& symbols,
                                 std::map<std::string, const Symbol*>& to) {
  for (const Symbol& symbol : symbols) {
    if (FindPredicate(symbol.name) || FindFunction(symbol.name)) {
      FailTwice(file, symbol.name, symbol.place);
    }
    if (!to.emplace(symbol.name, &symbol).second) FailTwice(file, symbol.name, symbol.place);
    for (const TypedName& parameter : symbol.parameters) {
      RequireType(file, parameter.type, parameter.place);
    }
    if (symbol.range != kNumberType) RequireType(file, symbol.range, symbol.place);
  }
}

void SymbolTable::DeclareConstants(const std::string& file,
                                   const std::vector<TypedName>& constants) {
  for (const TypedName& constant : constants) {
    RequireType(file, constant.type, constant.place);
    if (FindFunction(constant.name) || !constants_.emplace(constant.name, &constant).second) {
      FailTwice(file, constant.name, constant.place);
    }
    constants_in_order_.push_back(&constant);
  }
}

void SymbolTable::RequireType(const std::string& file, const std::string& type, Place place) const {
  if (type.empty() || HasType(type)) return;
  const std::string nearest = NearestName(type, TypeNames());
  throw InputError(
      {file, place.line, place.column},
      nearest.empty() ? fmt::format("unknown type '{}'", type)
                      : fmt::format("unknown type '{}', did you mean '{}'?", type, nearest),
      TypeNames().empty() ? "nothing" : fmt::format("{}", fmt::join(TypeNames(), ", ")));
}

bool SymbolTable::IsA(std::string type, const std::string& ancestor) const {
  if (ancestor.empty()) return type != kNumberType;
  while (!type.empty() && type != ancestor) {
    const auto parent = parents_.find(type);
    type = parent != parents_.end() ? parent->second : "";
  }
  return type == ancestor;
}

const std::vector<std::string>& SymbolTable::ConstantsOf(const std::string& type) const {
  const auto [entry, is_new] = constants_of_.try_emplace(type);
  if (is_new) {
    for (const TypedName* constant : constants_in_order_) {
      if (IsA(constant->type, type)) entry->second.push_back(constant->name);
    }
  }
  return entry->second;
}

std::vector<std::string> SymbolTable::PredicateNames() const { return Keys(predicates_); }
std::vector<std::string> SymbolTable::FunctionNames() const { return Keys(functions_); }
std::vector<std::string> SymbolTable::ExternNames() const { return Keys(externs_); }
std::vector<std::string> SymbolTable::ConstantNames() const { return Keys(constants_); }
std::vector<std::string> SymbolTable::TypeNames() const { return Keys(parents_); }

}  // namespace assay::contingent
