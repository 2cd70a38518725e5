#include "sim/exec/action_commands.h"

namespace assay::exec {

std::vector<Command> CommandsFor(const domain::Problem& problem, const plan::Pickup& pickup) {
  const domain::Workcell& workcell = *problem.workcell;
  const Pose grasp = pickup.from.X_WorldPart * pickup.hold.X_PartTool;
  const Pose retreated = Retreated(workcell, grasp);
  return {OpenGripper{},
          MoveAtSafeHeight{AtSafeHeight(workcell, retreated)},
          MoveStraight{retreated, kFreePace},
          MoveStraight{grasp, kFingersPace},
          CloseGripper{pickup.part, pickup.hold},
          MoveStraight{AtSafeHeight(workcell, grasp), kFreePace}};
}

}  // namespace assay::exec
