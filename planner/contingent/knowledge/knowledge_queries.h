#pragma once

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/knowledge/atom_knowledge.h"
#include "planner/contingent/knowledge/knowledge_state.h"
#include "planner/contingent/knowledge/number_knowledge.h"

namespace assay::contingent {

// Answers queries about a knowledge state.
class KnowledgeQueries {
 public:
  // Keeps references to the task and the atoms.
  KnowledgeQueries(const GroundTask& task, AtomKnowledge& atoms)
      : task_(task), layout_(task), numbers_(task), atoms_(atoms) {}

  // Returns true if the query surely holds. A query that something is not known does not surely
  // hold if more may be known than the state says. This is the case for numbers that depend on
  // others.
  bool Holds(const GroundQuery& query, const KnowledgeState& state) const;
  // Returns true unless the query surely does not hold.
  bool MayHold(const GroundQuery& query, const KnowledgeState& state) const;

  // Returns true if the formula is known to be true or known to be false.
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
