#include "planner/contingent/language/two_values.h"

namespace assay::contingent {

FunctionId FunctionGiven(const GroundTask& task, const GroundChange& change) {
  if (change.kind == GroundChange::Kind::kAssign) return change.function;
  if (change.kind != GroundChange::Kind::kSet || !change.literal.is_positive) {
    return FunctionId::None();
  }
  return task.function_of_atom[change.literal.atom.index()];
}

bool GiveTwoValues(const GroundTask& task, const GroundChange& a, const GroundChange& b) {
  const FunctionId function = FunctionGiven(task, a);
  return !function.IsNone() && function == FunctionGiven(task, b) &&
         (a.literal != b.literal || a.sum != b.sum);
}

Diagram WhereTwoValues(const GroundTask& task, std::vector<ChangeSomewhere> changes,
                       DecisionDiagrams& diagrams) {
  if (task.functions.empty()) return kEmptySet;
  std::erase_if(changes, [&](const ChangeSomewhere& change) {
    return FunctionGiven(task, *change.first).IsNone() || change.second == kEmptySet;
  });
  Diagram worlds = kEmptySet;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!GiveTwoValues(task, *changes[i].first, *changes[j].first)) continue;
      worlds = diagrams.Or(worlds, diagrams.And(changes[i].second, changes[j].second));
    }
  }
  return worlds;
}

}  // namespace assay::contingent
