#pragma once

#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/world_sets/decision_diagram.h"

namespace assay::contingent {

// Sets of worlds of a task as decision diagrams, and what actions make of them (forward images, as
// in Burch, Clarke, McMillan, Dill and Hwang 1992). Each atom has a variable, and another one for
// its value after an action. The check of trees relies on this class, so it shares no inference
// with the planner.
class SymbolicWorlds : public DecisionDiagrams {
 public:
  explicit SymbolicWorlds(const GroundTask& task);  // keeps a reference

  // Return the worlds where a literal, a condition of an effect, or a conjunction is true. The
  // condition must ask only about the world: it consists of K of literals, combined by `and` and
  // `or`.
  Diagram Where(GroundLiteral literal);
  Diagram Where(const GroundQuery& condition);
  Diagram Where(const Formula& conjunction);

  // Returns the worlds that the initial relations allow, with the known atoms substituted.
  Diagram Initial();
  // Returns the part of the worlds where the initially known literals are true.
  Diagram Assumed(Diagram worlds);
  // Returns the atoms that neither a relation nor a known literal mentions.
  std::set<AtomId> OpenAtoms(Diagram initial);
  // Returns the number of choices in `worlds` for the unknown atoms of the initial relations.
  double CountOf(Diagram worlds);

  // Returns the worlds after the action.
  Diagram Image(const GroundAction& action, Diagram worlds);

  // Returns the true atoms of one world of the set. Atoms are false where the set leaves a choice.
  std::string TextOfAWorld(Diagram worlds) const;

 private:
  struct Fate;

  int Variable(AtomId atom) const { return 2 * places_[atom.index()]; }
  double ShareOf(Diagram f, std::unordered_map<Diagram, double>& known);
  std::map<AtomId, Fate> FatesOf(const GroundAction& action);
  Diagram NewValue(AtomId atom, const Fate& fate);

  const GroundTask& task_;
  std::vector<int> places_;
};

}  // namespace assay::contingent
