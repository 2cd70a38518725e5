#include "planner/constraint_posting/resolvers/sensing_resolver.h"

#include "planner/constraint_posting/resolvers/plan_states.h"

namespace assay::constraint_posting {
namespace {

// Returns each sensor alone, then each pair, then all sensors.
std::vector<std::vector<std::string>> SetsOf(const std::vector<std::string>& sensors) {
  std::vector<std::vector<std::string>> sets;
  for (const std::string& sensor : sensors) sets.push_back({sensor});
  for (std::size_t first = 0; first < sensors.size(); ++first) {
    for (std::size_t second = first + 1; second < sensors.size(); ++second) {
      sets.push_back({sensors[first], sensors[second]});
    }
  }
  if (sensors.size() > 2) sets.push_back(sensors);
  return sets;
}

}  // namespace

std::vector<Remedy> SensingResolver::Propose(const UnmetGoals& unmet) {
  const std::vector<plan::WorldState> states = plan::StatesOf(unmet.problem, unmet.actions);
  std::vector<Remedy> remedies;
  for (const domain::PartId part : unmet.parts) {
    const auto index = LatestFree(states, unmet.step, part);
    if (!index) continue;
    const plan::Place at = PlaceBefore(unmet, states, *index, part);
    for (const std::vector<std::string>& set : SetsOf(unmet.problem.sensors)) {
      Remedy& remedy = remedies.emplace_back(Remedy{.part = part});
      for (const std::string& sensor : set) {
        remedy.insertions.push_back({*index, LookAt(part, sensor, at)});
      }
    }
  }
  return remedies;
}

}  // namespace assay::constraint_posting
