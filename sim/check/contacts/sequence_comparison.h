#pragma once

#include <optional>
#include <vector>

#include "sim/check/contacts/contact_sequence.h"

namespace assay::check {

// Where a trial left its plan.
struct Divergence {
  int motion = 0;  // index
  double time = 0;
  ContactSet planned = {};                  // the state that was to come, or the last one
  std::optional<ContactSet> observed = {};  // none: the trial ended before it came

  bool operator==(const Divergence&) const = default;
};

// A contact that was made and not to be, or not made or kept and to be, for kLeastDwell or longer.
struct ContactEvent {
  int motion = 0;
  ContactKey contact;
  bool is_loss = false;

  auto operator<=>(const ContactEvent&) const = default;
};

struct SequenceComparison {
  std::optional<Divergence> divergence = {};  // the first; none: the sequences match
  // Least number of states to put in, take out or exchange.
  int edit_distance = 0;
  std::vector<ContactEvent> events = {};  // ascending

  bool matches() const { return !divergence; }
};

// Contacts that are let go at the same time open one after the other, in an order that no plan
// tells: from a planned state to the next one, which is a part of it, states that are each a part
// of the one before and hold the next one are on the way, and are not counted. Nothing else is:
// made contacts come one at a time in plans, too.
SequenceComparison Compare(const PlannedContacts& planned, const std::vector<ContactSpan>& bridged);

std::optional<Divergence> FirstDivergence(const std::vector<ContactSet>& planned,
                                          const std::vector<ObservedState>& observed);
int EditDistance(const std::vector<ContactSet>& planned,
                 const std::vector<ObservedState>& observed);

}  // namespace assay::check
