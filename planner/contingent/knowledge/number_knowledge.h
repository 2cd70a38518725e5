#pragma once

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/knowledge/knowledge_state.h"

namespace assay::contingent {

// The knowledge of a state about the values of numeric functions, which are intervals and sensor
// errors, and its changes. A number that depends on other numbers or on atoms has an interval that
// does not express all knowledge. The interval is marked (Range::is_outer).
class NumberKnowledge {
 public:
  // Keeps a reference to the task.
  explicit NumberKnowledge(const GroundTask& task) : task_(task), layout_(task) {}

  bool IsNumber(FunctionId function) const { return SlotOf(function) >= 0; }
  const Range& RangeOf(FunctionId function, const KnowledgeState& state) const {
    return state.ranges[SlotOf(function)];
  }

  bool Holds(const Bound& bound, const KnowledgeState& state) const {
    return SurelyHolds(bound, RangeOf(bound.function, state));
  }
  // Returns true unless the bound surely does not hold.
  bool MayHold(const Bound& bound, const KnowledgeState& state) const;
  // Returns true if some number satisfies all bounds.
  bool CanBe(FunctionId function, const KnowledgeState& state) const;

  // Gives the function the value of the change's sum in the world.
  void Assign(const GroundChange& change, const KnowledgeState& before,
              KnowledgeState& state) const;
  void Forget(KnowledgeState& state, FunctionId function) const;
  // Widens the interval so that it contains `otherwise`. This is needed for a number if it is
  // unknown whether a change of the number has happened.
  void Unsettle(KnowledgeState& state, FunctionId function, const Range& otherwise) const;
  // Marks the number as dependent on something else.
  void Entangle(KnowledgeState& state, FunctionId function) const {
    MutableRangeOf(function, state).is_outer = true;
  }

  // Records that the number was sensed with at most this error.
  void Sense(KnowledgeState& state, FunctionId function, double error) const;
  void Learn(KnowledgeState& state, const Bound& bound) const;

 private:
  int SlotOf(FunctionId function) const { return task_.functions[function.index()].slot; }
  Range& MutableRangeOf(FunctionId function, KnowledgeState& state) const {
    return state.ranges[SlotOf(function)];
  }
  Range SumOf(const GroundSum& sum, const KnowledgeState& state) const;

  const GroundTask& task_;
  StateLayout layout_;
};

}  // namespace assay::contingent
