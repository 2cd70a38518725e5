#pragma once

#include <variant>

#include "planner/domain/problem/problem.h"
#include "planner/plan/check/world_state.h"
#include "planner/plan/data/plan.h"

namespace assay::assembly {

// Where a strategy cannot be executed, though there be no errors.
struct Unreached {
  int motion = 0;                // where this one ends, from 1; 0: where the first one starts
  geometry::Pose X_WorldTool;    // as it would have to be there
  domain::PartId obstacle = {};  // that the hand would go through; None: the arm does not get there
};

// The arm's joint values where the strategy starts, in a configuration in which it comes to the
// ends of all motions, with the hand free of all parts there; or what is in the way.
using StrategyReach = std::variant<kinematics::JointVector, Unreached>;

// `before`: the world in which the action is executed; the held part may be anywhere.
StrategyReach ReachOf(const domain::Problem& problem, const plan::Assemble& assemble,
                      const plan::Strategy& strategy, const plan::WorldState& before);

// With which a strategy can be executed, and where the arm then is at first.
struct ReachingHold {
  plan::Hold hold;
  kinematics::JointVector start;
};

// For an action that is the problem's only one after the held part's pickup: the action's own hold
// if it reaches, else that of another grasp with which the part can be taken where it is at the
// start, and mated. If none does, what is in the way of the action's own.
std::variant<ReachingHold, Unreached> ChooseHold(const domain::Problem& problem,
                                                 const plan::Assemble& assemble,
                                                 const plan::Strategy& strategy);

}  // namespace assay::assembly
