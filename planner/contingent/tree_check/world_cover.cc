#include "planner/contingent/tree_check/world_cover.h"

#include <algorithm>
#include <cmath>

namespace assay::contingent {

bool WorldCover::IsOpen(std::size_t slot) const {
  const Range& range = task_.initial.ranges[slot];
  return std::isinf(range.low) && std::isinf(range.high);
}

bool WorldCover::IsCaseOf(const World& world, const World& of) const {
  for (std::size_t a = 0; a < world.atoms.size(); ++a) {
    if (of.atoms[a] != Truth::kEither && of.atoms[a] != world.atoms[a]) return false;
  }
  for (std::size_t slot = 0; slot < world.numbers.size(); ++slot) {
    if (!IsOpen(slot) && world.numbers[slot] != of.numbers[slot]) return false;
  }
  return true;
}

bool WorldCover::IsCovered(const World& world, const Worlds& by) {
  if (std::any_of(by.begin(), by.end(), [&](const World& w) { return IsCaseOf(world, w); })) {
    return true;
  }
  for (std::size_t a = 0; a < world.atoms.size(); ++a) {
    const bool tells_apart =
        world.atoms[a] == Truth::kEither && std::any_of(by.begin(), by.end(), [&](const World& w) {
          return w.atoms[a] != Truth::kEither;
        });
    if (!tells_apart) continue;
    Worlds cases = {world};
    progression_.SplitBy(AtomId(a), cases);
    return std::all_of(cases.begin(), cases.end(),
                       [&](const World& w) { return IsCovered(w, by); });
  }
  return false;
}

History WorldCover::ToCompare(History history) const {
  for (World& world : history.worlds) {
    for (std::size_t slot = 0; slot < world.numbers.size(); ++slot) {
      if (IsOpen(slot)) world.numbers[slot] = {};
    }
  }
  std::sort(history.worlds.begin(), history.worlds.end());
  history.worlds.erase(std::unique(history.worlds.begin(), history.worlds.end()),
                       history.worlds.end());
  return history;
}

bool HasSensed(const History& history, const History& begun) {
  return std::ranges::includes(history.sensed, begun.sensed) &&
         std::ranges::all_of(begun.values_sensed, [&](const auto& value) {
           const auto known = history.values_sensed.find(value.first);
           return known != history.values_sensed.end() && known->second <= value.second;
         });
}

History WithSensedOf(const History& history, History begun) {
  std::erase_if(begun.sensed, [&](FormulaId f) { return !history.sensed.contains(f); });
  std::erase_if(begun.values_sensed,
                [&](const auto& value) { return !history.values_sensed.contains(value.first); });
  for (auto& [function, error] : begun.values_sensed) {
    error = std::max(error, history.values_sensed.at(function));
  }
  return begun;
}

}  // namespace assay::contingent
