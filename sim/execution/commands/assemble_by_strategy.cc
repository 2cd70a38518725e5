#include "sim/execution/commands/action_commands.h"

namespace assay::execution {

StepCommands CommandsToMateBy(const plan::Strategy& strategy, const domain::Problem& problem,
                              const WorldModel& world, const plan::Action& assemble) {
  const domain::Workcell& workcell = *problem.workcell;
  const domain::Mating& mating = problem.mating(assemble.mating);
  const Pose X_WorldFixed = world.PartPose(mating.fixed);
  const Pose X_WorldHeld = X_WorldFixed * mating.X_FixedHeld;
  const plan::ToolRoute route = plan::RouteOf(problem, assemble, &strategy, X_WorldFixed);
  const Pose& above = route.poised;
  const Pose& start = route.to_work.back();
  const Pose& retreated = route.left();
  StepCommands commands = {
      .approach = {MoveAtSafeHeight{AtSafeHeight(workcell, above)}, MoveStraight{above, kFreePace},
                   MoveStraight{start, kFreePace}},
      .advance = {FollowStrategy{strategy, mating.fixed}},
      .depart = {OpenGripper{OpenGripper::Release{mating.held, X_WorldHeld}},
                 MoveStraight{retreated, kFingersPace},
                 MoveStraight{AtSafeHeight(workcell, retreated), kFreePace}}};
  ClampFixed(problem, mating, commands);
  return commands;
}

}  // namespace assay::execution
