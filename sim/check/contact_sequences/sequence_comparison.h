#pragma once

#include <optional>
#include <vector>

#include "sim/check/contact_sequences/contact_sequence.h"

namespace assay::check {

// The place where a trial left its plan.
struct Divergence {
  int motion = 0;  // index
  double time = 0;
  // The state that should have come next, or the last planned state.
  ContactSet planned = {};
  // The state that came; missing if the trial ended first.
  std::optional<ContactSet> observed = {};

  bool operator==(const Divergence&) const = default;
};

// An unwanted contact or a missing one, for kLeastDwell or longer. A missing contact (`is_loss`)
// was planned but was not made or not kept.
struct ContactEvent {
  int motion = 0;
  ContactKey contact;
  bool is_loss = false;

  auto operator<=>(const ContactEvent&) const = default;
};

// The comparison of a trial's contacts with its plan's.
struct SequenceComparison {
  std::optional<Divergence> divergence = {};  // the first; missing if the sequences match
  // The least number of states to insert, remove or replace.
  int edit_distance = 0;
  std::vector<ContactEvent> events = {};  // ascending

  bool matches() const { return !divergence; }
};

// Compares a trial's contacts with the plan's. Contacts that are broken at the same time open one
// after the other, in an order that no plan determines. The states on the way from a planned state
// to the next, smaller one are therefore not counted: each is a part of the state before it and
// contains the next planned one. Everything else counts, since contacts are made one at a time in
// plans as well.
SequenceComparison Compare(const PlannedContacts& planned, const std::vector<ContactSpan>& bridged);

// Returns the first place where the observed states leave the planned ones.
std::optional<Divergence> FirstDivergence(const std::vector<ContactSet>& planned,
                                          const std::vector<ObservedState>& observed);
// Returns the edit distance between the planned states and the observed ones.
int EditDistance(const std::vector<ContactSet>& planned,
                 const std::vector<ObservedState>& observed);

}  // namespace assay::check
