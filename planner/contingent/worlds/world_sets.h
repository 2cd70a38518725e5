#pragma once

#include <vector>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/knowledge/open_bounds.h"
#include "planner/contingent/worlds/decision_diagram.h"

namespace assay::contingent {

// Sets of worlds as diagrams over a task's atoms. Each atom has two variables: its own, and one
// that stands for its new value while an effect is computed. Behind them are those of open bounds.
class WorldSets : public DecisionDiagrams {
 public:
  explicit WorldSets(const GroundTask& task);

  int Variable(AtomId atom) const { return 2 * places_[atom.index()]; }
  int NewVariable(AtomId atom) const { return Variable(atom) + 1; }
  bool IsOfAtom(int variable) const { return variable < 2 * std::ssize(atom_at_); }
  // The atom of a variable, which is of one.
  AtomId AtomOf(int variable) const { return atom_at_[variable / 2]; }

  Diagram Where(GroundLiteral literal) {
    return Literal({Variable(literal.atom), literal.is_positive});
  }
  // Where a condition that asks K alone is true.
  Diagram Where(const GroundQuery& condition, OpenBounds& bounds);
  Diagram WhereAll(const std::vector<GroundLiteral>& literals);
  // Where exactly one, or at least one, of the literals holds.
  Diagram WhereOne(const std::vector<GroundLiteral>& literals, bool is_inclusive);

 private:
  std::vector<int> places_;
  std::vector<AtomId> atom_at_;
};

}  // namespace assay::contingent
