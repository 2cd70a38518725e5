#include "sim/exec/action_commands.h"

namespace assay::exec {

std::vector<Command> CommandsFor(const domain::Problem& problem, const plan::Assemble& assemble) {
  const domain::Workcell& workcell = *problem.workcell;
  const domain::Mating& mating = problem.mating(assemble.mating);
  const Pose X_WorldHeld = assemble.fixed.X_WorldPart * mating.X_FixedHeld;
  const Vector3 vector = assemble.fixed.X_WorldPart.linear() * mating.mating_vector;
  const Vector3 short_of = -kReleaseHeight * vector.normalized();
  const Pose mated = geometry::Translation(short_of) * X_WorldHeld * assemble.hold.X_PartTool;
  const Pose start = geometry::Translation(-vector) * mated;
  const Pose retreated = Retreated(workcell, mated);
  return {MoveAtSafeHeight{AtSafeHeight(workcell, start)},
          MoveStraight{start, kFreePace},
          MoveStraight{mated, kMatingPace},
          OpenGripper{OpenGripper::Release{mating.held, X_WorldHeld}},
          MoveStraight{retreated, kFingersPace},
          MoveStraight{AtSafeHeight(workcell, retreated), kFreePace}};
}

}  // namespace assay::exec
