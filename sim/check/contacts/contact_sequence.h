#pragma once

#include <optional>
#include <vector>

#include "planner/finemotion/search/strategy_search.h"

namespace assay::check {

using finemotion::ContactKey;
using ContactSet = std::vector<ContactKey>;  // ascending, each once

// What touched during some of a trial's time, in one motion of its strategy.
struct ContactSpan {
  int motion = 0;    // index
  double start = 0;  // seconds
  double end = 0;
  ContactSet contacts = {};
};

// What lasts less is no state, and no loss of one: parts that meet rebound once or twice, within
// 10 milliseconds, while a motion of a strategy takes 100 to settle.
inline constexpr double kLeastDwell = 0.03;  // seconds

// Contacts that are lost for less than `dwell` and made again are there in between, too. Spans
// follow each other without a break.
std::vector<ContactSpan> Bridged(const std::vector<ContactSpan>& spans, double dwell = kLeastDwell);

// A contact state that a trial was in.
struct ObservedState {
  ContactSet contacts = {};
  double start = 0;  // seconds
  double dwell = 0;  // seconds
  int motion = 0;    // at its start
};

// What lasts less than `dwell` is a transition and belongs to no state; a state before it that is
// the same as that after it goes on.
std::vector<ObservedState> StatesOf(const std::vector<ContactSpan>& bridged,
                                    double dwell = kLeastDwell);

// What a plan says that touches.
struct PlannedContacts {
  struct Motion {
    ContactSet before = {};  // when it starts
    ContactSet kept = {};    // of those; the others are let go
    std::optional<ContactKey> until = {};
    ContactSet after = {};

    bool Wants(const ContactKey& key) const;  // at any time of it
  };
  std::vector<Motion> motions = {};
  std::vector<ContactSet> states = {};  // from free space on; neighbours differ
};

// The way on in the crevice, in which walls may be touched, is none of these motions
// (finemotion::StrategyOf adds it).
PlannedContacts PlannedContactsOf(const finemotion::FineMotionPlan& plan);

}  // namespace assay::check
