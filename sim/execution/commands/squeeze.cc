#include "sim/execution/commands/action_commands.h"

namespace assay::execution {

StepCommands CommandsToSqueeze(const domain::Problem& problem, const WorldModel& world,
                               const plan::Action& squeeze) {
  const domain::Workcell& workcell = *problem.workcell;
  const Pose X_WorldPart = world.PartPose(squeeze.part);
  const plan::ToolRoute route = plan::RouteOf(problem, squeeze, nullptr, X_WorldPart);
  const Pose& retreated = route.poised;
  const Pose& grasp = route.to_work.back();
  const OpenGripper let_go{OpenGripper::Release{squeeze.part, X_WorldPart}};
  return {.approach = {OpenGripper{}, MoveAtSafeHeight{AtSafeHeight(workcell, retreated)},
                       MoveStraight{retreated, kFreePace}},
          .advance = {MoveStraight{grasp, kFingersPace, Guard{kResistance}}},
          .act = {CloseGripper{squeeze.part, squeeze.hold, true}},
          .depart = {let_go, MoveStraight{retreated, kFingersPace},
                     MoveStraight{AtSafeHeight(workcell, retreated), kFreePace}},
          .withdraw = {let_go, MoveStraight{retreated, kFingersPace}}};
}

}  // namespace assay::execution
