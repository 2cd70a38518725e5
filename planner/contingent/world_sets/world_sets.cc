#include "planner/contingent/world_sets/world_sets.h"

#include "planner/contingent/world_sets/variable_order.h"

namespace assay::contingent {

WorldSets::WorldSets(const GroundTask& task)
    : places_(PlacesOfAtoms(task)), atom_at_(task.atoms.size()) {
  for (std::size_t i = 0; i < places_.size(); ++i) atom_at_[places_[i]] = AtomId(i);
}

Diagram WorldSets::Where(const GroundQuery& condition, OpenBounds& bounds) {
  if (condition.kind == GroundQuery::Kind::kKnown) return Where(condition.literal);
  if (condition.kind == GroundQuery::Kind::kBoundKnown) return bounds.WorldsWhere(condition.bound);
  const bool is_and = condition.kind == GroundQuery::Kind::kAnd;
  Diagram worlds = is_and ? kAllSets : kEmptySet;
  for (const GroundQuery& operand : condition.operands) {
    const Diagram of_operand = Where(operand, bounds);
    worlds = is_and ? And(worlds, of_operand) : Or(worlds, of_operand);
  }
  return worlds;
}

Diagram WorldSets::WhereAll(const std::vector<GroundLiteral>& literals) {
  Diagram worlds = kAllSets;
  for (const GroundLiteral& literal : literals) worlds = And(worlds, Where(literal));
  return worlds;
}

Diagram WorldSets::WhereOne(const std::vector<GroundLiteral>& literals, bool is_inclusive) {
  std::vector<Assignment> assignments;
  assignments.reserve(literals.size());
  for (const GroundLiteral& l : literals) {
    assignments.push_back({Variable(l.atom), l.is_positive});
  }
  return is_inclusive ? AtLeastOne(assignments) : ExactlyOne(assignments);
}

}  // namespace assay::contingent
