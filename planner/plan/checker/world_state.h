#pragma once

#include <span>
#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"

namespace assay::plan {

// The checker's own model of the world, and of what the actions need and do. An action's kind names
// its needs and where it leaves the part, and the checker gives these names their meaning with
// whole poses in place of labels. It does not use the action templates, with which the planner
// searches.

enum class PartStatus {
  kResting,  // at X_WorldPart, not mated into another part
  kHeld,     // in the hand; X_WorldPart has no meaning
  kMated,    // at X_WorldPart, in its fixed part
};

struct PartState {
  PartStatus status = PartStatus::kResting;
  Pose X_WorldPart = Pose::Identity();
  StepId moved_by;  // last step that took, put down or mated it; None: not moved yet
};

struct WorldState {
  std::vector<PartState> parts;  // by PartId
  PartId in_hand;                // None: the hand is empty and open
  Hold hold;                     // grasp of the part in the hand
  std::vector<MatingId> assembled;

  const PartState& part(PartId id) const { return parts[id.index()]; }
};

// Returns whether the checker takes two poses as the same: they agree to 1 micrometre, and to 1
// microradian in the axes.
bool PosesAgree(const Pose& a, const Pose& b);

// Returns "x y z mm", for messages of the checker.
std::string InMillimetres(const geometry::Vector3& p);

WorldState InitialState(const domain::Problem& problem);

// Returns what the action needs and the state does not have, in words. A part that is mated into
// another, or has another mated into it, cannot be picked up or squeezed: the actions handle one
// part at a time. The fixed part of an assemble action may itself be mated into a third one.
std::vector<std::string> BrokenPreconditions(const domain::Problem& problem,
                                             const WorldState& state, const Action& action);

// Returns the state after the action, assuming that its preconditions held.
WorldState StateAfter(const domain::Problem& problem, WorldState state, const Action& action,
                      StepId step);

// Returns the state before each action of a plan instance, and after the last action.
std::vector<WorldState> StatesOf(const domain::Problem& problem, std::span<const Action> actions);

}  // namespace assay::plan
