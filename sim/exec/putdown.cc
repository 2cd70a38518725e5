#include "sim/exec/action_commands.h"

namespace assay::exec {

std::vector<Command> CommandsFor(const domain::Problem& problem, const plan::Putdown& putdown) {
  const domain::Workcell& workcell = *problem.workcell;
  const Pose placed = geometry::Translation(0, 0, kReleaseHeight) * putdown.to.X_WorldPart *
                      putdown.hold.X_PartTool;
  const Pose retreated = Retreated(workcell, placed);
  return {MoveAtSafeHeight{AtSafeHeight(workcell, placed)}, MoveStraight{placed, kLandingPace},
          OpenGripper{OpenGripper::Release{putdown.part, putdown.to.X_WorldPart}},
          MoveStraight{retreated, kFingersPace},
          MoveStraight{AtSafeHeight(workcell, retreated), kFreePace}};
}

}  // namespace assay::exec
