#pragma once

#include <optional>
#include <vector>

#include "planner/plan/check/world_state.h"
#include "planner/posting/resolvers/resolver.h"

namespace assay::posting {

// The (nominal) world before each action of a plan instance, and after the last.
std::vector<plan::WorldState> StatesOf(const domain::Problem& problem,
                                       std::span<const plan::Action> actions);

// The latest moment up to that of `step` at which the part rests, neither held nor mated into
// another; none if it never does.
std::optional<int> LatestFree(const std::vector<plan::WorldState>& states, int step,
                              domain::PartId part);
// The latest at which, besides, the hand is empty and the part is mated with no other.
std::optional<int> LatestGraspable(const domain::Problem& problem,
                                   const std::vector<plan::WorldState>& states, int step,
                                   domain::PartId part);

// What is left to do in a state with an empty hand, as a problem: parts are and matings hold at the
// start as they do there. Errors are left as they are.
domain::Problem ProblemFrom(domain::Problem problem, const plan::WorldState& state);

// Where the part is before actions[moment], labelled as the action that brought it there does.
plan::Place PlaceBefore(const UnmetGoals& unmet, const std::vector<plan::WorldState>& states,
                        int moment, domain::PartId part);

}  // namespace assay::posting
