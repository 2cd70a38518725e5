#include "planner/contingent/variable_order.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace assay::contingent {
namespace {

constexpr int kRounds = 60;

// Moves every atom to the mean of the centres of its relations; true if the order has changed.
bool Improve(const std::vector<InitialRelation>& relations, std::vector<int>& places) {
  std::vector<double> sums(places.size(), 0);
  std::vector<int> counts(places.size(), 0);
  for (const InitialRelation& relation : relations) {
    double centre = 0;
    for (const GroundLiteral& l : relation.literals) centre += places[l.atom.index()];
    centre /= static_cast<double>(relation.literals.size());
    for (const GroundLiteral& l : relation.literals) {
      sums[l.atom.index()] += centre;
      ++counts[l.atom.index()];
    }
  }
  const auto wanted = [&](int atom) {
    return counts[atom] > 0 ? sums[atom] / counts[atom] : places[atom];
  };
  std::vector<int> order(places.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return wanted(a) != wanted(b) ? wanted(a) < wanted(b) : places[a] < places[b];
  });
  std::vector<int> moved(places.size());
  for (std::size_t i = 0; i < order.size(); ++i) moved[order[i]] = static_cast<int>(i);
  return std::exchange(places, moved) != places;
}

}  // namespace

std::vector<int> PlacesOfAtoms(const GroundTask& task) {
  std::vector<int> places(task.atoms.size());
  std::iota(places.begin(), places.end(), 0);
  for (int round = 0; round < kRounds; ++round) {
    if (!Improve(task.initial.relations, places)) break;
  }
  return places;
}

}  // namespace assay::contingent
