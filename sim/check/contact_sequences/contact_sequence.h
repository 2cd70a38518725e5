#pragma once

#include <optional>
#include <vector>

#include "planner/finemotion/strategy_search/strategy_search.h"

namespace assay::check {

using finemotion::ContactKey;
using ContactSet = std::vector<ContactKey>;  // ascending, each key once

// The contacts in one interval of a trial, which lies within one motion of its strategy.
struct ContactSpan {
  int motion = 0;    // index
  double start = 0;  // seconds
  double end = 0;
  ContactSet contacts = {};
};

// A contact must last this long to belong to a state, and be absent this long to count as lost.
// Parts that meet rebound once or twice within 10 milliseconds, while a motion of a strategy takes
// 100 to settle.
inline constexpr double kLeastDwell = 0.03;  // seconds

// Returns the spans without short losses of contacts. If a contact is lost and is made again after
// less than kLeastDwell, it counts as not lost. Each span must begin where the one before it ends.
std::vector<ContactSpan> Bridged(const std::vector<ContactSpan>& spans);

// A contact state that a trial was in.
struct ObservedState {
  ContactSet contacts = {};
  double start = 0;  // seconds
  double dwell = 0;  // seconds
  int motion = 0;    // the motion in which the state begins
};

// Returns the contact states of a trial in order. A contact set that lasts less than kLeastDwell is
// a transition and belongs to no state. If the states before and after a transition are equal, they
// are one state.
std::vector<ObservedState> StatesOf(const std::vector<ContactSpan>& bridged);

// The contacts that a plan expects.
struct PlannedContacts {
  struct Motion {
    ContactSet before = {};  // contacts when the motion starts
    ContactSet kept = {};    // contacts of `before` that are kept; the others are broken
    // The contact that ends the motion, if it waits for one.
    std::optional<ContactKey> until = {};
    ContactSet after = {};

    // Returns whether the contact is planned at any time of the motion.
    bool Wants(const ContactKey& key) const;
  };
  std::vector<Motion> motions = {};
  std::vector<ContactSet> states = {};  // from free space on; no two in a row are equal
};

// Returns the contacts that a plan expects in each of its motions. The last slide in the hole, in
// which the part may touch walls, is not one of these motions (finemotion::StrategyOf adds it).
PlannedContacts PlannedContactsOf(const finemotion::FineMotionPlan& plan);

}  // namespace assay::check
