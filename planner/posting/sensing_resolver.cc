#include "planner/posting/sensing_resolver.h"

#include <functional>
#include <set>

#include "planner/posting/moment.h"

namespace assay::posting {

std::vector<Remedy> SensingResolver::Propose(const UnmetGoals& unmet) {
  const std::vector<plan::WorldState> states = StatesOf(unmet.problem, unmet.actions);
  std::vector<Remedy> remedies;
  for (const domain::PartId part : unmet.Parts()) {
    std::set<int, std::greater<>> moments;  // the latest first
    if (const auto free = LatestFree(states, unmet.step, part)) moments.insert(*free);
    if (const auto graspable = LatestGraspable(unmet.problem, states, unmet.step, part)) {
      moments.insert(*graspable);
    }
    for (const std::string& sensor : unmet.problem.sensors) {
      for (const int moment : moments) {
        const plan::Place at = PlaceBefore(unmet, states, moment, part);
        remedies.push_back({.insertions = {{moment, plan::Sense{part, sensor, at}}}});
      }
    }
  }
  return remedies;
}

}  // namespace assay::posting
