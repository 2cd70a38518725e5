#pragma once

#include <vector>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/knowledge/knowledge_state.h"
#include "planner/contingent/world_sets/decision_diagram.h"

namespace assay::contingent {

// The bounds in the conditions of an action's effects whose truth a state does not know. The number
// decides the bound, and the bound decides all effects that ask it. For the time of the action,
// each bound is a variable of the diagrams, after the variables of the atoms.
class OpenBounds {
 public:
  // Keeps references to all arguments.
  OpenBounds(const GroundTask& task, const KnowledgeState& state, DecisionDiagrams& diagrams)
      : task_(task), state_(state), diagrams_(diagrams) {}

  // Returns the set of worlds where the bound holds: all worlds, no world, or, if its truth is
  // unknown, the set where the bound's variable is true.
  Diagram WorldsWhere(const Bound& bound);
  // Returns the combinations of the bounds seen so far that can hold together. One bound on a
  // number may decide another one.
  Diagram Together() const;
  std::vector<int> Variables() const;
  // Returns true if one of the bounds seen so far is on a number of which more is known than its
  // range says.
  bool AreOuter() const;

 private:
  const Range& RangeOf(const Bound& bound) const {
    return state_.ranges[task_.functions[bound.function.index()].slot];
  }
  int VariableOf(std::size_t bound) const {
    return static_cast<int>(2 * task_.atoms.size() + bound);
  }

  const GroundTask& task_;
  const KnowledgeState& state_;
  DecisionDiagrams& diagrams_;
  std::vector<Bound> bounds_;
};

}  // namespace assay::contingent
