#pragma once

#include <string>
#include <vector>

#include "planner/contingent/knowledge_base.h"
#include "sim/enact/interpretation.h"

namespace assay::enact {

// Something that is claimed to be known and is not so.
struct FalseClaim {
  int step = 0;  // after which it is claimed; 0: before the first
  std::string atom;
  bool claimed = false;
  bool is_true = false;
};

// What a knowledge state claims to know, against the simulator: every atom with a meaning that is
// known to be true or known to be false.
class Audit {
 public:
  // Keep references.
  Audit(const Interpretation& interpretation, const domain::Problem& problem)
      : interpretation_(interpretation), problem_(problem) {}

  std::vector<FalseClaim> FalseClaims(const contingent::KnowledgeBase& knowledge,
                                      const contingent::KnowledgeState& state, const Truth& truth,
                                      int step) const;

  // The goal with what is true in place of what is known. What it asks of knowledge alone, Kw and
  // Kv, counts as met.
  bool IsGoalTrue(const Truth& truth) const;

 private:
  bool IsTrue(contingent::AtomId atom, const Truth& truth) const;
  bool Holds(const contingent::GroundQuery& query, const Truth& truth) const;

  const Interpretation& interpretation_;
  const domain::Problem& problem_;
};

}  // namespace assay::enact
