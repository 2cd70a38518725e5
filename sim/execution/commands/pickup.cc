#include "sim/execution/commands/action_commands.h"

namespace assay::execution {

StepCommands CommandsToTake(const domain::Problem& problem, const WorldModel& world,
                            const plan::Action& pickup) {
  const domain::Workcell& workcell = *problem.workcell;
  const plan::ToolRoute route =
      plan::RouteOf(problem, pickup, nullptr, world.PartPose(pickup.part));
  const Pose& retreated = route.poised;
  const Pose& grasp = route.to_work.back();
  return {.approach = {OpenGripper{}, MoveAtSafeHeight{AtSafeHeight(workcell, retreated)},
                       MoveStraight{retreated, kFreePace}},
          .advance = {MoveStraight{grasp, kFingersPace, Guard{kResistance}}},
          .act = {CloseGripper{pickup.part, pickup.hold}},
          .depart = {MoveStraight{AtSafeHeight(workcell, grasp), kFreePace}},
          .withdraw = {OpenGripper{OpenGripper::Release{pickup.part, world.PartPose(pickup.part)}},
                       MoveStraight{retreated, kFingersPace}}};
}

}  // namespace assay::execution
