#include "sim/exec/action_commands.h"

namespace assay::exec {

std::vector<Command> CommandsFor(const domain::Problem& problem, const plan::Squeeze& squeeze) {
  const domain::Workcell& workcell = *problem.workcell;
  const Pose grasp = squeeze.at.X_WorldPart * squeeze.hold.X_PartTool;
  const Pose retreated = Retreated(workcell, grasp);
  return {OpenGripper{},
          MoveAtSafeHeight{AtSafeHeight(workcell, retreated)},
          MoveStraight{retreated, kFreePace},
          MoveStraight{grasp, kFingersPace},
          CloseGripper{squeeze.part, squeeze.hold},
          OpenGripper{OpenGripper::Release{squeeze.part, squeeze.at.X_WorldPart}},
          MoveStraight{retreated, kFingersPace},
          MoveStraight{AtSafeHeight(workcell, retreated), kFreePace}};
}

}  // namespace assay::exec
