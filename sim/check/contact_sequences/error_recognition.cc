#include "sim/check/contact_sequences/error_recognition.h"

#include <algorithm>

namespace assay::check {
namespace {

constexpr double kBefore = 0.01;  // seconds

bool HasName(const ContactSet& contacts, const std::string& name) {
  return std::ranges::any_of(contacts,
                             [&](const ContactKey& key) { return finemotion::Name(key) == name; });
}

// A strategy that went on in an error state ends in that same error state, which is counted once.
std::vector<execution::ErrorState> ErrorStatesOf(const execution::StrategyEnd& end) {
  std::vector<execution::ErrorState> states = end.recovered;
  states.insert(states.end(), end.ignored.begin(), end.ignored.end());
  if (end.outcome != execution::TrialOutcome::kSucceeded && end.ignored.empty()) {
    states.push_back({.outcome = end.outcome,
                      .motion = end.motion,
                      .recognized = end.recognized,
                      .time = end.time});
  }
  return states;
}

void Add(const std::optional<execution::RecognizedContact>& recognized,
         const std::vector<ContactSpan>& bridged, Recognition& recognition) {
  ++recognition.errors;
  if (!recognized) return;
  ++recognition.named;
  if (IsRight(*recognized, bridged)) ++recognition.right;
}

}  // namespace

bool IsRight(const execution::RecognizedContact& named, const std::vector<ContactSpan>& bridged) {
  const bool is_there = std::ranges::any_of(bridged, [&](const ContactSpan& span) {
    return span.end >= named.time - kBefore && span.start <= named.time &&
           HasName(span.contacts, named.name);
  });
  return is_there != named.is_loss;
}

void Count(const execution::StrategyEnd& end, const std::vector<ContactSpan>& bridged,
           bool diverged, RecognitionTally& tally) {
  std::vector<execution::ErrorState> states = ErrorStatesOf(end);
  std::erase_if(states, [&](const execution::ErrorState& state) {
    return std::ranges::count(bridged, state.motion, &ContactSpan::motion) == 0;
  });
  for (const execution::ErrorState& state : states) Add(state.recognized, bridged, tally.states);
  if (!diverged) {
    tally.needless += static_cast<int>(std::ssize(states));
    return;
  }
  const auto named = std::ranges::find_if(
      states, [](const execution::ErrorState& state) { return state.recognized.has_value(); });
  Add(named == states.end() ? std::nullopt : named->recognized, bridged, tally.unwanted);
}

}  // namespace assay::check
