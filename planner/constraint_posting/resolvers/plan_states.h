#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/constraint_posting/resolvers/resolver.h"
#include "planner/plan/checker/world_state.h"

namespace assay::constraint_posting {

// Functions for resolvers, about the nominal states of the world (plan::StatesOf) in a plan
// instance that they add steps to.

// Returns the index of the latest action, up to `step`, before which the part rests, neither held
// nor mated into another part. Returns none if there is no such action.
std::optional<int> LatestFree(const std::vector<plan::WorldState>& states, int step,
                              domain::PartId part);
// Returns the index of the latest action, up to `step`, before which the hand is empty and the part
// is mated with no other part. Returns none if there is no such action.
std::optional<int> LatestGraspable(const domain::Problem& problem,
                                   const std::vector<plan::WorldState>& states, int step,
                                   domain::PartId part);

// Returns the problem that a resolver has in a state with an empty hand: the rest of the given
// problem. Its parts and matings at the start are the parts and matings of the state. The errors
// are unchanged.
domain::Problem ProblemFrom(domain::Problem problem, const plan::WorldState& state);

// Returns the place of the part before actions[moment], with the label of the action that brought
// it there.
plan::Place PlaceBefore(const UnmetGoals& unmet, const std::vector<plan::WorldState>& states,
                        int index, domain::PartId part);

// Returns the look at a part by which a resolver reduces its errors. The part lies at the place.
plan::Action LookAt(domain::PartId part, const std::string& sensor, const plan::Place& at);

}  // namespace assay::constraint_posting
