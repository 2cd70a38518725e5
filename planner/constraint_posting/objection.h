#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "planner/base/budget.h"
#include "planner/plan/data/plan.h"

namespace assay::constraint_posting {

struct PartInTheWay {
  domain::PartId part;
  std::string why;  // a precondition that fails as long as the part is there, with its bound
};

// The reason why an action of a plan instance cannot be proved, whatever remedies are inserted. The
// uncertainty phase passes it to the constraint-posting planner, which then makes another instance
// or posts a goal (Spar, "Satisfying Uncertainty-Reduction Goals", leaves this open).
struct Objection {
  int action = 0;  // index of the action in the order of execution
  // The parts that the action handles or whose errors occur in the unproved preconditions. Their
  // poses and their grasps take part in the failure.
  std::vector<domain::PartId> parts = {};
  // True if earlier actions on these parts take part in the failure. False if the action fails even
  // with the best knowledge that earlier actions could give.
  bool history = false;
  // True if the places of the parts take part in the failure, and not only their stable poses and
  // grasps.
  bool place = false;
  // Parts that the action does not handle and that would have to be elsewhere.
  std::vector<PartInTheWay> in_the_way = {};
  std::string why = {};  // the precondition that fails by most, with its bound
};

struct Judgement {
  std::vector<Objection> objections = {};  // empty if there are none
  // The cost of the judgement: one, plus the number of snapshots of world trees that it computed.
  std::int64_t snapshots = 0;
};

// Takes the cost of a judgement from the budget.
inline void Charge(Budget& snapshots, const Judgement& judgement) {
  for (std::int64_t i = 0; i < judgement.snapshots; ++i) snapshots.Spend();
}

// Judges the last of `actions`, which are the first actions of a plan instance. Before this call,
// every shorter beginning of these actions must have been judged without objection, the shorter
// ones first. Every sequence that is judged after such a beginning must start with this beginning.
using Judge = std::function<Judgement(std::span<const plan::Action> actions)>;

}  // namespace assay::constraint_posting
