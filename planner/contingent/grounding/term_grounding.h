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

// The value of a variable: a constant, or the value that a function has at run time.
struct GroundValue {
  std::string text;
  FunctionId function;  // none for a constant
};

struct Binding {
  std::string variable;
  GroundValue value;
};
using Bindings = std::vector<Binding>;

// Makes terms without variables, and enumerates the ways to bind variables. It holds the data that
// all grounding classes share: the task that is being made, its atoms, and the file that is being
// read.
class TermGrounding {
 public:
  // Keeps references to all arguments.
  TermGrounding(const SymbolTable& symbols, AtomTable& table, GroundTask& task)
      : symbols_(symbols), table_(table), task_(task) {}

  const SymbolTable& symbols() const { return symbols_; }
  AtomTable& table() { return table_; }
  GroundTask& task() { return task_; }

  // Sets the file to which places refer.
  void Enter(const std::string& file) { file_ = &file; }
  FilePlace PlaceOf(Place place) const { return {*file_, place.line, place.column}; }
  [[noreturn]] void Fail(Place place, const std::string& what, const std::string& allowed) const;

  bool IsNumeric(const Term& term) const;
  GroundValue ValueOf(const Term& term, const Bindings& bindings);
  // Returns the arguments of a predicate, a function or an extern, where no run-time variable may
  // stand.
  std::vector<std::string> Constants(const std::vector<Term>& terms, const Bindings& bindings);
  FunctionId FunctionOf(const Term& term, const Bindings& bindings);
  // Returns f(a) and c for a literal f(a) = c in init or among alternatives. Returns none if f is
  // numeric.
  std::optional<std::pair<FunctionId, std::string>> EqualityOf(const Literal& literal,
                                                               const Bindings& bindings);
  GroundSum SumOf(const Term& term, const Bindings& bindings);
  Bound BoundOf(const Literal& literal, const Bindings& bindings);

  // Calls `use` for each way to bind the variables from index `from` on. During each call,
  // `bindings` also contains the bindings of this way. Throws InputError before the first call if
  // there are too many ways, because each takes memory.
  void ForEachBinding(const std::vector<TypedName>& variables, Bindings& bindings, std::size_t from,
                      const std::function<void()>& use);
  // Counts one attempt to bind an action's parameters. Throws InputError after too many attempts.
  void CountBinding(Place place);

  // Records that a run-time variable, or a value outside a function's range, stands where it may
  // not. The instance that is being grounded is then left out.
  void Refuse() { is_refused_ = true; }
  bool is_refused() const { return is_refused_; }
  // Returns is_refused() and resets it.
  bool TakeRefusal() { return std::exchange(is_refused_, false); }

 private:
  void CountInstances(const std::vector<TypedName>& variables);

  const SymbolTable& symbols_;
  AtomTable& table_;
  GroundTask& task_;
  const std::string* file_ = nullptr;
  std::int64_t bindings_ = 0;  // attempts to bind parameters so far
  double instances_ = 0;       // instances of effects and queries with variables
  bool is_refused_ = false;
};

}  // namespace assay::contingent
