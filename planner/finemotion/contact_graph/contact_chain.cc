#include "planner/finemotion/contact_graph/contact_chain.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "planner/finemotion/contacts/contact_finder.h"
#include "planner/geometry/pose.h"

namespace assay::finemotion {

namespace {

constexpr double kReach = 0.003;  // metres within which features count as near a critical point
constexpr double kPast = 1e-3;    // metres past a critical point where contacts are linearized
constexpr double kClosed = 1e-6;  // metres; smaller gaps are closed

LocalTopology TopologyAt(const MatingGeometry& geometry, const Pose& X_FixedTip) {
  const Passage& passage = geometry.passage;
  LocalTopology topology{
      .X_StationaryMoving = X_FixedTip,
      .space = {PrimitiveContacts(passage.moving, passage.stationary, X_FixedTip, kReach)},
      .graph = {}};
  ContactGraphOptions options;
  for (const PrimitiveContact& contact : topology.space.contacts)
    options.radius = std::max(options.radius, contact.at.norm());
  topology.graph = MakeContactGraph(topology.space, options);
  return topology;
}

std::vector<LocalTopology> TopologiesOf(const MatingGeometry& geometry) {
  std::vector<LocalTopology> topologies;
  const std::vector<CriticalPoint>& points = geometry.critical_points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool is_last = i + 1 == points.size();
    const double crevice = is_last ? 0 : points[i + 1].travel - points[i].travel;
    const double past = std::min(kPast, crevice / 2);
    topologies.push_back(
        TopologyAt(geometry, geometry::Translation(past * geometry.passage.mating) *
                                 points[i].X_StationaryMoving * geometry.X_HeldTip));
  }
  if (points.empty()) topologies.push_back(TopologyAt(geometry, geometry.X_FixedSeat));
  return topologies;
}

// Returns whether the state is one-dimensional and leads along the mating direction.
bool IsCrevice(const LocalTopology& topology, const ContactState& state, const Vector3& mating) {
  return state.dimension == 1 && std::ranges::all_of(state.contacts, [&](int contact) {
           const Vector3& normal =
               topology.space.contacts[static_cast<std::size_t>(contact)].normal;
           return std::abs(normal.dot(mating)) <= kAcross;
         });
}

std::map<std::vector<ContactKey>, int> CrevicesOf(const LocalTopology& topology,
                                                  const Vector3& mating) {
  std::map<std::vector<ContactKey>, int> crevices;
  for (int i = 0; i < std::ssize(topology.graph.states); ++i) {
    if (IsCrevice(topology, topology.graph.states[static_cast<std::size_t>(i)], mating))
      crevices.emplace(topology.ContactsOf(i), i);
  }
  return crevices;
}

std::vector<SharedState> SharedBy(const LocalTopology& earlier, const LocalTopology& later,
                                  const Vector3& mating) {
  std::vector<SharedState> shared;
  const auto in_later = CrevicesOf(later, mating);
  for (const auto& [contacts, state] : CrevicesOf(earlier, mating)) {
    if (const auto found = in_later.find(contacts); found != in_later.end())
      shared.push_back({state, found->second});
  }
  return shared;
}

// Returns the 0-dimensional states in which every contact touches that stops the part when there
// are no errors.
std::vector<int> SeatedStates(const LocalTopology& at_seat, const Vector3& mating) {
  std::vector<int> seated;
  for (int i = 0; i < std::ssize(at_seat.graph.states); ++i) {
    const ContactState& state = at_seat.graph.states[static_cast<std::size_t>(i)];
    if (state.dimension > 0) continue;
    const auto stays = [&](const PrimitiveContact& contact) {
      const bool stops =
          std::abs(contact.offset) <= kClosed && contact.normal.dot(mating) < -kAcross;
      return !stops || std::abs(contact.Gap(state.target_points.front())) <= kClosed;
    };
    if (std::ranges::all_of(at_seat.space.contacts, stays)) seated.push_back(i);
  }
  return seated;
}

}  // namespace

std::vector<ContactKey> LocalTopology::ContactsOf(int state) const {
  std::vector<ContactKey> keys;
  for (const int contact : graph.states[static_cast<std::size_t>(state)].contacts)
    keys.push_back(KeyOf(space.contacts[static_cast<std::size_t>(contact)]));
  std::ranges::sort(keys);
  return keys;
}

std::optional<int> LocalTopology::LeastTransitions() const {
  std::optional<int> least;
  for (const int state : initial) {
    const int transitions = graph.states[static_cast<std::size_t>(state)].to_goal;
    if (transitions >= 0 && (!least || transitions < *least)) least = transitions;
  }
  return least;
}

ContactChain ContactChainOf(const MatingGeometry& geometry) {
  ContactChain chain{TopologiesOf(geometry), {}};
  chain.points.front().initial = {0};
  for (std::size_t i = 0; i + 1 < chain.points.size(); ++i) {
    LocalTopology& earlier = chain.points[i];
    LocalTopology& later = chain.points[i + 1];
    chain.shared.push_back(SharedBy(earlier, later, geometry.passage.mating));
    for (const SharedState& state : chain.shared.back()) {
      earlier.goals.push_back(state.earlier);
      later.initial.push_back(state.later);
    }
  }
  chain.points.back().goals = SeatedStates(chain.points.back(), geometry.passage.mating);
  for (LocalTopology& point : chain.points) point.graph.MeasureTo(point.goals);
  return chain;
}

}  // namespace assay::finemotion
