#include "sim/check/contact_sequences/contact_sequence.h"

#include <algorithm>
#include <map>

#include "planner/base/check.h"

namespace assay::check {
namespace {

bool Has(const ContactSet& set, const ContactKey& key) {
  return std::ranges::binary_search(set, key);
}

void Add(const ContactKey& key, ContactSet& set) {
  if (!Has(set, key)) set.insert(std::ranges::upper_bound(set, key), key);
}

}  // namespace

std::vector<ContactSpan> Bridged(const std::vector<ContactSpan>& spans) {
  std::vector<ContactSpan> bridged = spans;
  std::map<ContactKey, std::size_t> last;  // the last span with the contact
  for (std::size_t i = 0; i < spans.size(); ++i) {
    ASSAY_CHECK(i == 0 || spans[i].start >= spans[i - 1].start, "spans in their order");
    for (const ContactKey& key : spans[i].contacts) {
      const auto before = last.find(key);
      if (before != last.end() && spans[i].start - spans[before->second].end < kLeastDwell) {
        for (std::size_t k = before->second + 1; k < i; ++k) Add(key, bridged[k].contacts);
      }
      last[key] = i;
    }
  }
  return bridged;
}

std::vector<ObservedState> StatesOf(const std::vector<ContactSpan>& bridged) {
  std::vector<ObservedState> phases;  // contact sets of any duration
  for (const ContactSpan& span : bridged) {
    if (phases.empty() || phases.back().contacts != span.contacts)
      phases.push_back({span.contacts, span.start, 0, span.motion});
    phases.back().dwell += span.end - span.start;
  }
  std::vector<ObservedState> states;
  for (const ObservedState& phase : phases) {
    if (phase.dwell < kLeastDwell) continue;
    if (!states.empty() && states.back().contacts == phase.contacts) {
      states.back().dwell += phase.dwell;
    } else {
      states.push_back(phase);
    }
  }
  return states;
}

bool PlannedContacts::Motion::Wants(const ContactKey& key) const {
  return Has(before, key) || Has(after, key);
}

PlannedContacts PlannedContactsOf(const finemotion::FineMotionPlan& plan) {
  PlannedContacts planned{.motions = {}, .states = {{}}};
  const auto pass = [&](const ContactSet& state) {
    if (planned.states.back() != state) planned.states.push_back(state);
  };
  for (const finemotion::CertainMotion& motion : plan.motions) {
    PlannedContacts::Motion out;
    if (!planned.motions.empty()) out.before = planned.motions.back().after;
    for (const ContactKey& key : motion.command.kept) Add(key, out.kept);
    out.until = motion.command.until;
    out.after = out.kept;
    if (out.until) Add(*out.until, out.after);
    pass(out.kept);
    pass(out.after);
    planned.motions.push_back(std::move(out));
  }
  return planned;
}

}  // namespace assay::check
