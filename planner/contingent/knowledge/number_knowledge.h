#pragma once

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/knowledge/knowledge_state.h"

namespace assay::contingent {

// What a state knows of functions' values that are numbers, intervals and what is sensed of them,
// and how that changes. Where numbers hang together with others or with atoms, an interval is not
// all that is known, and is marked so (Range::is_outer).
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
  // Not surely not.
  bool MayHold(const Bound& bound, const KnowledgeState& state) const;
  // Whether there is a number that satisfies all bounds.
  bool CanBe(FunctionId function, const KnowledgeState& state) const;

  // The world changes.
  void Assign(const GroundChange& change, const KnowledgeState& before,
              KnowledgeState& state) const;
  void Forget(KnowledgeState& state, FunctionId function) const;
  // What may have happened to a number leaves its interval wide enough for `otherwise`, too.
  void Unsettle(KnowledgeState& state, FunctionId function, const Range& otherwise) const;
  // It hangs together with something else from now on.
  void Entangle(KnowledgeState& state, FunctionId function) const {
    MutableRangeOf(function, state).is_outer = true;
  }

  // More is known of the world.
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
