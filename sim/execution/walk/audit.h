#pragma once

#include <string>
#include <vector>

#include "planner/contingent/knowledge/knowledge_base.h"
#include "sim/execution/interpretation/interpretation.h"

namespace assay::execution {

// Something that a knowledge state claims to know and that is false in the simulator.
struct FalseClaim {
  int step = 0;  // the number of steps executed before the claim; 0: before the first step
  std::string atom;
  bool claimed = false;
  bool is_true = false;
  std::string truth = {};  // the true state in words, for numbers and relations only
};

// Compares what a knowledge state claims to know with the simulator's truth. The audit covers:
// - every audited atom (Predicate::IsAudited) that is known to be true or known to be false;
// - every relation of Kx, in which atoms that are not audited may have either value;
// - the interval of every numeric function that is a quantity of the workcell;
// - every numeric value that counts as sensed (Kv): a sensor must have read it, within the error.
class Audit {
 public:
  // Keeps references to both arguments.
  Audit(const Interpretation& interpretation, const domain::Problem& problem)
      : interpretation_(interpretation), problem_(problem) {}

  std::vector<FalseClaim> FalseClaims(contingent::KnowledgeBase& knowledge,
                                      const contingent::KnowledgeState& state, const Truth& truth,
                                      const Readings& readings, int step) const;

  // Returns whether the goal holds when known facts are replaced by the facts that are true in the
  // simulator. Parts of the goal that concern knowledge alone (Kw, Kv, and that something is
  // unknown) count as met, because TreeWalk checks them.
  bool IsGoalTrue(const Truth& truth) const;

 private:
  std::vector<FalseClaim> FalseAtoms(const contingent::KnowledgeBase& knowledge,
                                     const contingent::KnowledgeState& state, const Truth& truth,
                                     int step) const;
  std::vector<FalseClaim> FalseRelations(contingent::KnowledgeBase& knowledge,
                                         const contingent::KnowledgeState& state,
                                         const Truth& truth, int step) const;
  std::vector<FalseClaim> FalseNumbers(const contingent::KnowledgeBase& knowledge,
                                       const contingent::KnowledgeState& state, const Truth& truth,
                                       const Readings& readings, int step) const;
  bool IsAudited(contingent::AtomId atom) const;
  bool IsTrue(contingent::AtomId atom, const Truth& truth) const;
  // `function` must be a quantity of the workcell.
  double TrueValue(contingent::FunctionId function, const Truth& truth) const;
  bool Holds(const contingent::GroundQuery& query, const Truth& truth) const;

  const Interpretation& interpretation_;
  const domain::Problem& problem_;
};

}  // namespace assay::execution
