#include "planner/contingent/world_sets/variable_order.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace assay::contingent {
namespace {

constexpr int kRounds = 60;

// For each atom, the mean of the places that attract it.
class Attractions {
 public:
  explicit Attractions(const std::vector<int>& places)
      : places_(places), sums_(places.size(), 0), counts_(places.size(), 0) {}

  void Add(AtomId atom, double place) {
    sums_[atom.index()] += place;
    ++counts_[atom.index()];
  }

  // Returns the places after every atom has moved to the mean of its attracting places. Atoms with
  // equal means keep their order.
  std::vector<int> Follow() const {
    std::vector<int> order(places_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      return std::pair(Wanted(a), places_[a]) < std::pair(Wanted(b), places_[b]);
    });
    std::vector<int> moved(places_.size());
    for (std::size_t i = 0; i < order.size(); ++i) moved[order[i]] = static_cast<int>(i);
    return moved;
  }

 private:
  double Wanted(int atom) const {
    return counts_[atom] > 0 ? sums_[atom] / counts_[atom] : places_[atom];
  }

  const std::vector<int>& places_;
  std::vector<double> sums_;
  std::vector<int> counts_;
};

// Moves every atom to the mean of the centres of its relations. Returns true if the order has
// changed.
bool Improve(const std::vector<InitialRelation>& relations, std::vector<int>& places) {
  Attractions attractions(places);
  for (const InitialRelation& relation : relations) {
    double centre = 0;
    for (const GroundLiteral& l : relation.literals) centre += places[l.atom.index()];
    centre /= static_cast<double>(relation.literals.size());
    for (const GroundLiteral& l : relation.literals) attractions.Add(l.atom, centre);
  }
  std::vector<int> moved = attractions.Follow();
  return std::exchange(places, std::move(moved)) != places;
}

std::vector<bool> AreRelated(const std::vector<InitialRelation>& relations, std::size_t atoms) {
  std::vector<bool> are_related(atoms, false);
  for (const InitialRelation& relation : relations) {
    for (const GroundLiteral& l : relation.literals) are_related[l.atom.index()] = true;
  }
  return are_related;
}

void CollectAtoms(const GroundQuery& condition, std::vector<AtomId>& atoms) {
  if (condition.kind == GroundQuery::Kind::kKnown) atoms.push_back(condition.literal.atom);
  for (const GroundQuery& operand : condition.operands) CollectAtoms(operand, atoms);
}

// Puts atoms that have no initial relation after the atoms in the conditions of their effects,
// because such an effect relates them. For n alternatives with n symptoms, the diagram then has n
// nodes instead of n^2.
std::vector<int> BehindConditions(const GroundTask& task, const std::vector<int>& places) {
  const std::vector<bool> are_related = AreRelated(task.initial.relations, places.size());
  Attractions attractions(places);
  for (const GroundAction& action : task.actions) {
    for (const GroundEffect& effect : action.effects) {
      if (!effect.is_of_worlds) continue;
      std::vector<AtomId> named;
      CollectAtoms(effect.condition, named);
      std::erase_if(named, [&](AtomId atom) { return !are_related[atom.index()]; });
      for (const GroundChange& change : effect.changes) {
        const AtomId changed = change.literal.atom;
        if (change.kind != GroundChange::Kind::kSet || are_related[changed.index()]) continue;
        for (const AtomId atom : named) attractions.Add(changed, places[atom.index()] + 0.5);
      }
    }
  }
  return attractions.Follow();
}

}  // namespace

std::vector<int> PlacesOfAtoms(const GroundTask& task) {
  std::vector<int> places(task.atoms.size());
  std::iota(places.begin(), places.end(), 0);
  for (int round = 0; round < kRounds; ++round) {
    if (!Improve(task.initial.relations, places)) break;
  }
  return BehindConditions(task, places);
}

}  // namespace assay::contingent
