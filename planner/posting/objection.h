#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "planner/base/budget.h"
#include "planner/plan/data/plan.h"

namespace assay::posting {

struct PartInTheWay {
  domain::PartId part;
  std::string why;  // a precondition that fails as long as it is there, with its bound
};

// Why an action of a plan instance cannot be proved, whatever remedies are inserted: what the
// uncertainty phase tells the constraint-posting planner, so that it makes another instance or
// posts a goal (Spar, "Satisfying Uncertainty-Reduction Goals", leaves this open).
struct Objection {
  int action = 0;  // index, in the order of execution
  // Parts that it handles or whose errors occur in what is not proved: how they lie and how they
  // are held takes part in the failure.
  std::vector<domain::PartId> parts = {};
  // Whether how they came there does, too: not, if the action fails with all known that could be.
  bool history = false;
  // Whether where they lie does, and not only how.
  bool place = false;
  // Parts that the action does not handle and that would have to be elsewhere.
  std::vector<PartInTheWay> in_the_way = {};
  std::string why = {};  // the precondition that fails by most, with its bound
};

struct Judgement {
  std::vector<Objection> objections = {};  // empty: none
  std::int64_t moments = 0;  // its cost: of world trees, worked out for it; and one for itself
};

// Takes what a judgement cost.
inline void Charge(Budget& moments, const Judgement& judgement) {
  for (std::int64_t i = 0; i < judgement.moments; ++i) moments.Spend();
}

// Judges the last of the first actions of a plan instance. Each of those before it has been judged
// without objection, after those before it; what was judged since then began with it.
using Judge = std::function<Judgement(std::span<const plan::Action> actions)>;

}  // namespace assay::posting
