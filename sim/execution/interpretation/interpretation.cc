#include "sim/execution/interpretation/interpretation.h"

#include "sim/execution/interpretation/planned_worlds.h"

namespace assay::execution {

int Interpretation::WorldCount() const {
  return planned ? static_cast<int>(planned->worlds.size()) : 1;
}

const Predicate* Interpretation::PredicateOf(contingent::AtomId atom) const {
  return predicates.at(task.ground_atoms[atom.index()].symbol).get();
}

const Quantity* Interpretation::QuantityOf(contingent::FunctionId function) const {
  const auto found = quantities.find(task.functions[function.index()].symbol);
  return found == quantities.end() ? nullptr : found->second.get();
}

bool Interpretation::CanSpill(const Truth& truth, PartId part) const {
  return spill && predicates.at(spill->predicate)->IsTrue(truth, {.part = part});
}

}  // namespace assay::execution
