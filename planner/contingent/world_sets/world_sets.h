#pragma once

#include <vector>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/knowledge/open_bounds.h"
#include "planner/contingent/world_sets/decision_diagram.h"

namespace assay::contingent {

// Sets of worlds as diagrams over a task's atoms. Each atom has two variables: its own, and one for
// its new value during the computation of an effect. The variables of open bounds come after those
// of all atoms.
class WorldSets : public DecisionDiagrams {
 public:
  explicit WorldSets(const GroundTask& task);

  int Variable(AtomId atom) const { return 2 * places_[atom.index()]; }
  int NewVariable(AtomId atom) const { return Variable(atom) + 1; }
  bool IsOfAtom(int variable) const { return variable < 2 * std::ssize(atom_at_); }
  // Returns the atom of a variable. IsOfAtom must be true for the variable.
  AtomId AtomOf(int variable) const { return atom_at_[variable / 2]; }

  Diagram Where(GroundLiteral literal) {
    return Literal({Variable(literal.atom), literal.is_positive});
  }
  // Returns the worlds where a condition that asks only K is true.
  Diagram Where(const GroundQuery& condition, OpenBounds& bounds);
  Diagram WhereAll(const std::vector<GroundLiteral>& literals);
  // Returns the worlds where exactly one, or at least one, of the literals holds.
  Diagram WhereOne(const std::vector<GroundLiteral>& literals, bool is_inclusive);

 private:
  std::vector<int> places_;
  std::vector<AtomId> atom_at_;
};

}  // namespace assay::contingent
