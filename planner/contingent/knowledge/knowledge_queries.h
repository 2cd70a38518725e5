#pragma once

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/knowledge/atom_knowledge.h"
#include "planner/contingent/knowledge/knowledge_state.h"
#include "planner/contingent/knowledge/number_knowledge.h"

namespace assay::contingent {

// What a state answers.
class KnowledgeQueries {
 public:
  // Keeps references.
  KnowledgeQueries(const GroundTask& task, AtomKnowledge& atoms)
      : task_(task), layout_(task), numbers_(task), atoms_(atoms) {}

  // Surely: that something is not known does not hold where more may be known than the state says
  // (of numbers that hang together with others).
  bool Holds(const GroundQuery& query, const KnowledgeState& state) const;
  // Not surely not.
  bool MayHold(const GroundQuery& query, const KnowledgeState& state) const;

  // Whether it is known to be true, or known to be false.
  bool IsDetermined(const Formula& formula, const KnowledgeState& state) const;
  bool IsDetermined(FunctionId function, const KnowledgeState& state) const;

 private:
  bool IsValueKnown(const GroundQuery& query, const KnowledgeState& state) const;

  const GroundTask& task_;
  StateLayout layout_;
  NumberKnowledge numbers_;
  AtomKnowledge& atoms_;
};

}  // namespace assay::contingent
