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

// The knowledge about an atom: it is known to be true, known to be false, or unknown.
enum class Knowledge { kTrue, kFalse, kUnknown };

// The ground atoms, functions and formulas of a task, each stored once, with their knowledge from
// the problem's init.
class AtomTable {
 public:
  AtomTable(const Domain& domain, const Problem& problem, const SymbolTable& symbols,
            GroundTask& task);

  // Returns the knowledge of the atom p(a, b). Returns kUnknown unless the atom is known initially
  // and no action changes it.
  Knowledge AlwaysKnown(const std::string& predicate, const std::vector<std::string>& arguments);
  bool IsChanged(const std::string& name) const { return changed_.contains(name); }
  // Returns true for a function that some action or the init puts in Kv.
  bool IsSensed(const std::string& function) const { return sensed_.contains(function); }

  AtomId Atom(const std::string& predicate, const std::vector<std::string>& arguments);
  FunctionId Function(const std::string& name, const std::vector<std::string>& arguments);
  // Returns the atom f(...) = constant, or none if the constant is not in the function's range.
  AtomId Value(FunctionId function, const std::string& constant) const;
  FormulaId IdOf(const Formula& formula);

  // Records that init says that the atom with this text is true, false or unknown.
  void Tell(const std::string& atom, Knowledge knowledge) { stated_[atom] = knowledge; }
  void Close(const Change& change) {
    closed_[change.literals.front().predicate].push_back(&change);
  }

  // Makes an atom of each instance of a predicate that init says to be true or false.
  void AddKnown();
  // Returns the literals of all atoms made so far that are known initially.
  std::vector<GroundLiteral> KnownAtFirst() const;

 private:
  struct Key {
    std::string predicate;
    std::vector<std::string> arguments;
  };

  void FindChanged(const Effect& effect);
  // Returns all lists of arguments of the predicate. Each list has one constant of each parameter's
  // type.
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
  std::vector<Key> keys_;  // indexed by atom
  std::unordered_map<std::string, FunctionId> functions_;
  std::unordered_map<std::string, FormulaId> formulas_;
  std::unordered_map<std::string, Knowledge> stated_;
  std::map<std::string, std::vector<const Change*>> closed_;
};

// Returns the text of a ground atom: "p(a, b)", or "p" for a predicate without arguments.
std::string AtomText(const std::string& name, const std::vector<std::string>& arguments);

}  // namespace assay::contingent
