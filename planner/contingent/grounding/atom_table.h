#pragma once

#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/language/domain.h"
#include "planner/contingent/language/symbol_table.h"

namespace assay::contingent {

// Whether something is known.
enum class Knowledge { kTrue, kFalse, kUnknown };

// The ground atoms, functions and formulas of a task, each once, and what the problem's init says
// of them.
class AtomTable {
 public:
  AtomTable(const Domain& domain, const Problem& problem, const SymbolTable& symbols,
            GroundTask& task);

  // Of p(a, b): kUnknown unless it is known at first and no action changes it.
  Knowledge AlwaysKnown(const std::string& predicate, const std::vector<std::string>& arguments);
  bool IsChanged(const std::string& name) const { return changed_.contains(name); }
  // A function whose value some action or the init comes to know.
  bool IsSensed(const std::string& function) const { return sensed_.contains(function); }

  AtomId Atom(const std::string& predicate, const std::vector<std::string>& arguments);
  FunctionId Function(const std::string& name, const std::vector<std::string>& arguments);
  // f(...) = constant; none if the constant is not of the function's range.
  AtomId Value(FunctionId function, const std::string& constant) const;
  FormulaId IdOf(const Formula& formula);

  // The text of every fact that the init tells, true or false, and what is told not to be known.
  void Tell(const std::string& atom, Knowledge knowledge) { told_[atom] = knowledge; }
  void Close(const Change& change) {
    closed_[change.literals.front().predicate].push_back(&change);
  }

  // Every predicate's instance of which init says whether it is true becomes an atom.
  void AddKnown();
  // What is known at first of the atoms so far.
  std::vector<GroundLiteral> KnownAtFirst() const;

 private:
  struct Key {
    std::string predicate;
    std::vector<std::string> arguments;
  };

  void FindChanged(const Effect& effect);
  // One constant of each parameter's type.
  std::vector<std::vector<std::string>> ArgumentsOf(const Symbol& predicate) const;
  Knowledge AtFirst(const std::string& text, const Key& key) const;
  bool IsClosed(const Key& key) const;
  bool Matches(const Change& closed, const Key& key) const;
  AtomId Intern(const std::string& text, Key key, GroundAtom atom, FunctionId function);

  const SymbolTable& symbols_;
  GroundTask& task_;
  std::set<std::string> changed_;
  std::set<std::string> sensed_;
  std::unordered_map<std::string, AtomId> atoms_;
  std::vector<Key> keys_;  // by atom
  std::unordered_map<std::string, FunctionId> functions_;
  std::unordered_map<std::string, FormulaId> formulas_;
  std::unordered_map<std::string, Knowledge> told_;
  std::map<std::string, std::vector<const Change*>> closed_;
};

// "p(a, b)", "p" without arguments.
std::string AtomText(const std::string& name, const std::vector<std::string>& arguments);

}  // namespace assay::contingent
