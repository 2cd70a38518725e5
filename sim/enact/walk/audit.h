#pragma once

#include <string>
#include <vector>

#include "planner/contingent/knowledge/knowledge_base.h"
#include "sim/enact/walk/interpretation.h"

namespace assay::enact {

// Something that is claimed to be known and is not so.
struct FalseClaim {
  int step = 0;  // after which it is claimed; 0: before the first
  std::string atom;
  bool claimed = false;
  bool is_true = false;
  std::string truth = {};  // of numbers and relations, in words
};

// What a knowledge state claims to know, against the simulator: every atom about what is so
// (Meaning::IsAudited) that is known to be true or known to be false; every relation of Kx, in
// which other atoms may be either; the interval of every numeric function that is a quantity of the
// workcell; and if its value counts as sensed, that it has been read, within the error.
class Audit {
 public:
  // Keep references.
  Audit(const Interpretation& interpretation, const domain::Problem& problem)
      : interpretation_(interpretation), problem_(problem) {}

  std::vector<FalseClaim> FalseClaims(contingent::KnowledgeBase& knowledge,
                                      const contingent::KnowledgeState& state, const Truth& truth,
                                      const Readings& readings, int step) const;

  // The goal with what is true in place of what is known. What it asks of knowledge alone, Kw, Kv
  // and that something is not known, counts as met: that is the walk's business (TreeWalk).
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
  // Of one that is a quantity of the workcell.
  double TrueValue(contingent::FunctionId function, const Truth& truth) const;
  bool Holds(const contingent::GroundQuery& query, const Truth& truth) const;

  const Interpretation& interpretation_;
  const domain::Problem& problem_;
};

}  // namespace assay::enact
