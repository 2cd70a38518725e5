#include "sim/check/contact_sequences/sequence_comparison.h"

#include <algorithm>
#include <map>

namespace assay::check {
namespace {

bool IsProperPart(const ContactSet& part, const ContactSet& of) {
  return part.size() < of.size() && std::ranges::includes(of, part);
}

// Returns whether the observed state lies on the way between two planned states. Contacts of the
// first planned state that are not in the second planned state open one after the other.
bool IsLettingGo(const ContactSet& from, const ContactSet& to, const ContactSet& before,
                 const ContactSet& observed) {
  return IsProperPart(observed, from) && IsProperPart(observed, before) &&
         IsProperPart(to, observed);
}

// The times of contact within each motion, and the motions that the trial came to.
class MotionRecord {
 public:
  explicit MotionRecord(const std::vector<ContactSpan>& bridged) : spans_(bridged) {}

  bool Began(int motion) const {
    return std::ranges::any_of(spans_, [&](const auto& span) { return span.motion == motion; });
  }

  std::vector<ContactKey> Touching(int motion) const {
    ContactSet keys;
    for (const ContactSpan& span : spans_) {
      if (span.motion == motion)
        keys.insert(keys.end(), span.contacts.begin(), span.contacts.end());
    }
    std::ranges::sort(keys);
    const auto rest = std::ranges::unique(keys);
    keys.erase(rest.begin(), rest.end());
    return keys;
  }

  // Returns the longest unbroken time, in seconds, for which the contact was present in the motion,
  // or absent if `there` is false.
  double Longest(int motion, const ContactKey& key, bool there) const {
    double longest = 0;
    double time = 0;
    for (const ContactSpan& span : spans_) {
      if (span.motion != motion) continue;
      const bool is_there = std::ranges::binary_search(span.contacts, key);
      time = is_there == there ? time + span.end - span.start : 0;
      longest = std::max(longest, time);
    }
    return longest;
  }

 private:
  const std::vector<ContactSpan>& spans_;
};

std::vector<ContactEvent> EventsOf(const PlannedContacts::Motion& planned, int motion,
                                   const MotionRecord& record) {
  std::vector<ContactEvent> events;
  for (const ContactKey& key : record.Touching(motion)) {
    if (!planned.Wants(key) && record.Longest(motion, key, true) >= kLeastDwell)
      events.push_back({motion, key, false});
  }
  const bool is_wrong = !events.empty();
  for (const ContactKey& key : planned.kept) {
    if (record.Longest(motion, key, false) >= kLeastDwell) events.push_back({motion, key, true});
  }
  // A motion that stopped at another contact did not miss the contact that it waited for.
  const bool is_over = record.Began(motion + 1) || !is_wrong;
  if (planned.until && is_over && record.Longest(motion, *planned.until, true) < kLeastDwell)
    events.push_back({motion, *planned.until, true});
  return events;
}

}  // namespace

std::optional<Divergence> FirstDivergence(const std::vector<ContactSet>& planned,
                                          const std::vector<ObservedState>& observed) {
  std::size_t reached = 0;
  for (std::size_t i = 0; i < observed.size(); ++i) {
    const ObservedState& state = observed[i];
    const bool is_last = reached + 1 == planned.size();
    const ContactSet& next = is_last ? planned[reached] : planned[reached + 1];
    if (i == 0 && state.contacts == planned[0]) continue;
    if (i > 0 && !is_last && state.contacts == next) {
      ++reached;
      continue;
    }
    if (i > 0 && !is_last &&
        IsLettingGo(planned[reached], next, observed[i - 1].contacts, state.contacts)) {
      continue;
    }
    return Divergence{state.motion, state.start, i == 0 ? planned[0] : next, state.contacts};
  }
  if (!observed.empty() && reached + 1 == planned.size()) return std::nullopt;
  Divergence missing;
  missing.planned = planned[observed.empty() ? 0 : reached + 1];
  if (!observed.empty()) {
    missing.motion = observed.back().motion;
    missing.time = observed.back().start + observed.back().dwell;
  }
  return missing;
}

// Uses the algorithm of Wagner and Fischer (1974). States during the breaking of contacts cost
// nothing.
int EditDistance(const std::vector<ContactSet>& planned,
                 const std::vector<ObservedState>& observed) {
  // Entry i is the distance from the first i planned states to the observed states so far.
  std::vector<int> row(planned.size() + 1);
  for (std::size_t i = 0; i < row.size(); ++i) row[i] = static_cast<int>(i);
  for (std::size_t j = 0; j < observed.size(); ++j) {
    const ContactSet& state = observed[j].contacts;
    int diagonal = row[0]++;
    for (std::size_t i = 1; i < row.size(); ++i) {
      const bool is_on_the_way =
          i < planned.size() && j > 0 &&
          IsLettingGo(planned[i - 1], planned[i], observed[j - 1].contacts, state);
      const int put_in = row[i] + (is_on_the_way ? 0 : 1);
      const int exchanged = diagonal + (state == planned[i - 1] ? 0 : 1);
      diagonal = row[i];
      row[i] = std::min({put_in, exchanged, row[i - 1] + 1});
    }
  }
  return row.back();
}

SequenceComparison Compare(const PlannedContacts& planned,
                           const std::vector<ContactSpan>& bridged) {
  const std::vector<ObservedState> observed = StatesOf(bridged);
  SequenceComparison comparison{.divergence = FirstDivergence(planned.states, observed),
                                .edit_distance = EditDistance(planned.states, observed),
                                .events = {}};
  // A trial may have ended in a later motion than the one in which its last state began.
  if (comparison.divergence && !comparison.divergence->observed && !bridged.empty())
    comparison.divergence->motion = bridged.back().motion;
  const MotionRecord record(bridged);
  for (std::size_t i = 0; i < planned.motions.size(); ++i) {
    const int motion = static_cast<int>(i);
    if (!record.Began(motion)) continue;
    std::ranges::copy(EventsOf(planned.motions[i], motion, record),
                      std::back_inserter(comparison.events));
  }
  std::ranges::sort(comparison.events);
  return comparison;
}

}  // namespace assay::check
