#pragma once

#include <optional>
#include <vector>

#include "planner/finemotion/contact_graph/contact_graph.h"
#include "planner/finemotion/strategy_search/mating.h"

namespace assay::finemotion {

// Contact space about a critical point, and how its contact states are connected.
struct LocalTopology {
  Pose X_StationaryMoving = Pose::Identity();  // the tip's pose at which contacts are linearized
  ContactSpace space;
  ContactGraph graph;             // its states hold their distances from the goals
  std::vector<int> initial = {};  // states in which the way through this point begins
  std::vector<int> goals = {};    // states in which the way through this point ends

  // Returns the state's keys in ascending order.
  std::vector<ContactKey> ContactsOf(int state) const;
  // Returns the least number of transitions from an initial state to a goal, or none if there is no
  // way.
  std::optional<int> LeastTransitions() const;
};

// A contact state of the crevice between two critical points. The graphs of both points have it,
// with the same features touching.
struct SharedState {
  int earlier = 0;  // index of the state in the graph of the first point
  int later = 0;    // index of the state in the graph of the next point
};

// The contact graphs of all critical points of a mating, and the transitions between them (Dakin
// and Popplestone, section 4 and figures 9 and 10). One-dimensional states that two neighbours
// share are goals of the earlier graph and initial states of the later one. The first graph begins
// in free space. The last one ends in a 0-dimensional state with the moving part at its seat.
struct ContactChain {
  // One for each critical point, or one at the seat if there are none.
  std::vector<LocalTopology> points;
  // The states that each point shares with the next point; empty where the chain breaks.
  std::vector<std::vector<SharedState>> shared;
};

// Returns the contact chain of a mating. In the paper, contacts are linearized at each critical
// point. At such a point, contacts with the walls and contacts with the rim are at the same height.
// They restrict a tilt in the same way, so their linearized constraints have equal rows. A state
// that is one-dimensional in the crevice would therefore have three dimensions. Here, contacts are
// linearized 1 mm past each critical point, where the crevice already has a length. Only for the
// last critical point, they are linearized at the point itself.
ContactChain ContactChainOf(const MatingGeometry& geometry);

}  // namespace assay::finemotion
