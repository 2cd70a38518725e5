#pragma once

#include <string>

#include "planner/plan/data/action.h"

namespace assay::plan {

// Actions with their arguments in the order of the published domain (Spar, figure 2).

inline Action Pickup(PartId part, const Hold& hold, const Place& from) {
  return {.kind = &domain::kPickup, .part = part, .hold = hold, .place = from};
}
inline Action Putdown(PartId part, const Hold& hold, const Place& to) {
  return {.kind = &domain::kPutdown, .part = part, .hold = hold, .place = to};
}
inline Action Assemble(MatingId mating, const Hold& hold, const Place& fixed) {
  return {.kind = &domain::kAssemble, .mating = mating, .hold = hold, .place = fixed};
}
inline Action Sense(PartId part, const std::string& sensor, const Place& at) {
  return {.kind = &domain::kSense, .part = part, .place = at, .sensor = sensor};
}
inline Action Squeeze(PartId part, const Hold& hold, const Place& at) {
  return {.kind = &domain::kSqueeze, .part = part, .hold = hold, .place = at};
}

// Returns the action if it is of the kind, and null otherwise.
template <class ActionOrConst>
ActionOrConst* As(const domain::ActionKind& kind, ActionOrConst& action) {
  return action.Is(kind) ? &action : nullptr;
}

}  // namespace assay::plan
