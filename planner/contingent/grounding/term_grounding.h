#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/contingent/grounding/atom_table.h"
#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/language/domain.h"
#include "planner/contingent/language/symbol_table.h"

namespace assay::contingent {

// What a variable stands for: a constant, or the value of a function at run time.
struct GroundValue {
  std::string text;
  FunctionId function;  // none for a constant
};

struct Binding {
  std::string variable;
  GroundValue value;
};
using Bindings = std::vector<Binding>;

// Terms without variables, and the ways to bind variables. Holds what all of grounding shares: the
// task that is being made, its atoms, and the file that is being read.
class TermGrounding {
 public:
  // Keeps references to all of them.
  TermGrounding(const SymbolTable& symbols, AtomTable& table, GroundTask& task)
      : symbols_(symbols), table_(table), task_(task) {}

  const SymbolTable& symbols() const { return symbols_; }
  AtomTable& table() { return table_; }
  GroundTask& task() { return task_; }

  // What follows is of this file.
  void Enter(const std::string& file) { file_ = &file; }
  FilePlace PlaceOf(Place place) const { return {*file_, place.line, place.column}; }
  [[noreturn]] void Fail(Place place, const std::string& what, const std::string& allowed) const;

  bool IsNumeric(const Term& term) const;
  GroundValue ValueOf(const Term& term, const Bindings& bindings);
  // Arguments of a predicate, a function or an extern: no run-time variables.
  std::vector<std::string> Constants(const std::vector<Term>& terms, const Bindings& bindings);
  FunctionId FunctionOf(const Term& term, const Bindings& bindings);
  // Of f(a) = c, in init or among alternatives: f(a) and c; none if f is numeric.
  std::optional<std::pair<FunctionId, std::string>> EqualityOf(const Literal& literal,
                                                               const Bindings& bindings);
  GroundSum SumOf(const Term& term, const Bindings& bindings);
  Bound BoundOf(const Literal& literal, const Bindings& bindings);

  // Calls `use` with the bindings and each way to bind the variables, from this one on, as well.
  // Throws InputError, before the first, if there are too many of them: each takes memory.
  void ForEachBinding(const std::vector<TypedName>& variables, Bindings& bindings, std::size_t from,
                      const std::function<void()>& use);
  // Counts a way to bind an action's parameters that is tried. Throws InputError when there have
  // been too many.
  void CountBinding(Place place);

  // A run-time variable stands where none may: what is being grounded with it is left out.
  void Refuse() { is_refused_ = true; }
  bool is_refused() const { return is_refused_; }
  // Whether it was, and forgets it.
  bool TakeRefusal() { return std::exchange(is_refused_, false); }

 private:
  void CountInstances(const std::vector<TypedName>& variables);

  const SymbolTable& symbols_;
  AtomTable& table_;
  GroundTask& task_;
  const std::string* file_ = nullptr;
  std::int64_t bindings_ = 0;  // of parameters, that have been tried
  double instances_ = 0;       // of effects and queries with variables
  bool is_refused_ = false;
};

}  // namespace assay::contingent
