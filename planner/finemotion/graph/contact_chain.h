#pragma once

#include <optional>
#include <vector>

#include "planner/finemotion/contacts/mating.h"
#include "planner/finemotion/graph/contact_graph.h"

namespace assay::finemotion {

// Contact space about a critical point, and how its contact states hang together.
struct LocalTopology {
  Pose X_StationaryMoving = Pose::Identity();  // of the tip, where contacts are linearized
  ContactSpace space;
  ContactGraph graph;             // its states tell how far they are from the goals
  std::vector<int> initial = {};  // states that the way through it begins in
  std::vector<int> goals = {};    // and ends in

  std::vector<ContactKey> ContactsOf(int state) const;  // ascending
  // Of a way from an initial state to a goal, at least; none: there is no way.
  std::optional<int> LeastTransitions() const;
};

// A contact state of the crevice between two critical points, which both of their graphs have: the
// same features touch.
struct SharedState {
  int earlier = 0;  // state of the first one's graph
  int later = 0;    // and of the next one's
};

// The contact graphs of all critical points of a mating, and how the way leads from one to the next
// (Dakin and Popplestone, section 4 and figures 9 and 10): the one-dimensional states shared by
// neighbours are goals of the one and initial states of the next; the first one is begun in free
// space, the last one ended in a 0-dimensional state with the moving part at its seat.
struct ContactChain {
  std::vector<LocalTopology> points;             // at each critical point; if none, at the seat
  std::vector<std::vector<SharedState>> shared;  // of each and the next; none: it breaks there
};

// Contacts are linearized where the crevice after the critical point is 1 mm long (the last one's
// at the point itself), unlike in the paper. At the point it has no length: walls and rim are
// touched at the same height, what they say of a tilt is the same row, and what is one-dimensional
// in the crevice has three dimensions.
ContactChain ContactChainOf(const MatingGeometry& geometry);

}  // namespace assay::finemotion
