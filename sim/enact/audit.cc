#include "sim/enact/audit.h"

#include <algorithm>

namespace assay::enact {

using contingent::AtomId;
using contingent::GroundQuery;

std::vector<FalseClaim> Audit::FalseClaims(const contingent::KnowledgeBase& knowledge,
                                           const contingent::KnowledgeState& state,
                                           const Truth& truth, int step) const {
  std::vector<FalseClaim> found;
  for (std::size_t i = 0; i < interpretation_.task.atoms.size(); ++i) {
    const AtomId atom(i);
    if (knowledge.layout().IsUndetermined(state, atom)) continue;
    if (interpretation_.MeaningOf(atom) == nullptr) continue;
    const bool claimed = knowledge.layout().IsKnown(state, {atom, true});
    const bool is_true = IsTrue(atom, truth);
    if (claimed != is_true)
      found.push_back({step, interpretation_.task.atoms[i], claimed, is_true});
  }
  return found;
}

bool Audit::IsGoalTrue(const Truth& truth) const { return Holds(interpretation_.task.goal, truth); }

bool Audit::IsTrue(AtomId atom, const Truth& truth) const {
  const contingent::GroundAtom& ground = interpretation_.task.ground_atoms[atom.index()];
  return interpretation_.MeaningOf(atom)->IsTrue(truth, RolesOf(problem_, ground.arguments));
}

bool Audit::Holds(const GroundQuery& query, const Truth& truth) const {
  const auto holds = [&](const GroundQuery& operand) { return Holds(operand, truth); };
  switch (query.kind) {
    case GroundQuery::Kind::kAnd:
      return std::ranges::all_of(query.operands, holds);
    case GroundQuery::Kind::kOr:
      return std::ranges::any_of(query.operands, holds);
    case GroundQuery::Kind::kNot:
      return std::ranges::none_of(query.operands, holds);
    case GroundQuery::Kind::kKnown:
      return interpretation_.MeaningOf(query.literal.atom) == nullptr ||
             IsTrue(query.literal.atom, truth) == query.literal.is_positive;
    case GroundQuery::Kind::kBoundKnown:
    case GroundQuery::Kind::kSensed:
    case GroundQuery::Kind::kValueSensed:
      return true;
  }
  return false;
}

}  // namespace assay::enact
