#pragma once

#include <vector>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/knowledge/knowledge_state.h"
#include "planner/contingent/worlds/decision_diagram.h"

namespace assay::contingent {

// Bounds in the conditions of an action's effects of which a state does not know whether they hold.
// The number decides, and with it all effects that ask: for the time of the action each bound is a
// variable of the diagrams, behind those of the atoms.
class OpenBounds {
 public:
  // Keeps references.
  OpenBounds(const GroundTask& task, const KnowledgeState& state, DecisionDiagrams& diagrams)
      : task_(task), state_(state), diagrams_(diagrams) {}

  // Where the bound holds: all, none, or its variable.
  Diagram WorldsWhere(const Bound& bound);
  // Which of the bounds so far can hold together: what one says of the number may decide another.
  Diagram Together() const;
  std::vector<int> Variables() const;
  // Whether one of the bounds so far is of a number of which more is known than its range says.
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
