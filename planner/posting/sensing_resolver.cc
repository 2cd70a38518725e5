#include "planner/posting/sensing_resolver.h"

#include <algorithm>
#include <bit>

#include "planner/posting/moment.h"

namespace assay::posting {
namespace {

// The non-empty sets of so many sensors as bits, the smaller sets first.
std::vector<unsigned> SetsOf(std::size_t sensors) {
  std::vector<unsigned> sets;
  for (unsigned set = 1; set < 1U << sensors; ++set) sets.push_back(set);
  std::ranges::stable_sort(sets, {}, [](unsigned set) { return std::popcount(set); });
  return sets;
}

}  // namespace

std::vector<Remedy> SensingResolver::Propose(const UnmetGoals& unmet) {
  const std::vector<plan::WorldState> states = StatesOf(unmet.problem, unmet.actions);
  const std::vector<std::string>& sensors = unmet.problem.sensors;
  std::vector<Remedy> remedies;
  for (const domain::PartId part : unmet.Parts()) {
    const auto moment = LatestFree(states, unmet.step, part);
    if (!moment) continue;
    const plan::Place at = PlaceBefore(unmet, states, *moment, part);
    for (const unsigned set : SetsOf(sensors.size())) {
      Remedy& remedy = remedies.emplace_back(Remedy{.part = part});
      for (std::size_t s = 0; s < sensors.size(); ++s) {
        if ((set >> s & 1U) == 0) continue;
        remedy.insertions.push_back({*moment, plan::Sense{part, sensors[s], at}});
      }
    }
  }
  return remedies;
}

}  // namespace assay::posting
