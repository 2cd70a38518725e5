#include "sim/check/error_recognition.h"

#include <algorithm>

namespace assay::check {
namespace {

constexpr double kBefore = 0.01;  // seconds

bool HasName(const ContactSet& contacts, const std::string& name) {
  return std::ranges::any_of(contacts,
                             [&](const ContactKey& key) { return finemotion::Name(key) == name; });
}

}  // namespace

bool IsRight(const exec::RecognizedContact& named, double time,
             const std::vector<ContactSpan>& bridged) {
  const bool is_there = std::ranges::any_of(bridged, [&](const ContactSpan& span) {
    return span.end >= time - kBefore && span.start <= time && HasName(span.contacts, named.name);
  });
  return is_there != named.is_loss;
}

void Count(const exec::StrategyEnd& end, const std::vector<ContactSpan>& bridged,
           RecognitionTally& tally) {
  const auto count = [&](int motion, const auto& recognized, double time) {
    if (std::ranges::count(bridged, motion, &ContactSpan::motion) == 0) return;
    ++tally.errors;
    if (!recognized) return;
    ++tally.named;
    if (IsRight(*recognized, time, bridged)) ++tally.right;
  };
  for (const exec::ErrorState& state : end.recovered)
    count(state.motion, state.recognized, state.time);
  if (end.outcome != exec::MatingOutcome::kDone) count(end.motion, end.recognized, end.time);
}

}  // namespace assay::check
