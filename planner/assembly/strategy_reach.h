#pragma once

#include <variant>

#include "planner/domain/problem/problem.h"
#include "planner/plan/checker/world_state.h"
#include "planner/plan/data/plan.h"

namespace assay::assembly {

// The place where a strategy cannot be executed even without errors.
struct Unreached {
  // the number from 1 of the motion that ends there, or 0 for the start of the first motion
  int motion = 0;
  geometry::Pose X_WorldTool;  // the tool's required pose there
  // the part that the hand would go through, or None if the arm does not reach the pose
  domain::PartId obstacle = {};
};

// The arm's joint values at the start of the strategy, in a configuration in which the arm reaches
// the ends of all motions and the hand touches no part there. If there is no such configuration,
// the obstruction.
using StrategyReach = std::variant<kinematics::JointVector, Unreached>;

// Returns the start of the strategy if the arm can execute it, and the obstruction otherwise.
// `before` is the world in which the action is executed. The held part's pose in it does not
// matter.
StrategyReach ReachOf(const domain::Problem& problem, const plan::Action& assemble,
                      const plan::Strategy& strategy, const plan::WorldState& before);

// A hold with which a strategy can be executed, and the arm's joint values at the start.
struct ReachingHold {
  plan::Hold hold;
  kinematics::JointVector start;
};

// Chooses a hold for an action `assemble`, which must be the only action of the problem after the
// pickup of the held part. The result is the action's own hold if the arm can execute the strategy
// with it. Otherwise it is the hold of another grasp with which the part can be picked up at the
// start and mated, and the strategy executed. If there is none, returns the obstruction of the
// action's own hold.
std::variant<ReachingHold, Unreached> ChooseHold(const domain::Problem& problem,
                                                 const plan::Action& assemble,
                                                 const plan::Strategy& strategy);

}  // namespace assay::assembly
