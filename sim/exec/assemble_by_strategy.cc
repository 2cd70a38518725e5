#include <algorithm>

#include "sim/exec/action_commands.h"

namespace assay::exec {

StepCommands CommandsFor(const domain::Problem& problem, const WorldModel& world,
                         const plan::Assemble& assemble, const plan::Strategy& strategy) {
  const domain::Workcell& workcell = *problem.workcell;
  const domain::Mating& mating = problem.mating(assemble.mating);
  const Pose X_WorldFixed = world.PartPose(mating.fixed);
  const Pose X_WorldHeld = X_WorldFixed * mating.X_FixedHeld;
  const Pose retreated = Retreated(workcell, X_WorldHeld * assemble.hold.X_PartTool);
  const Pose start = X_WorldFixed * strategy.X_FixedStart * strategy.X_HeldTip.inverse() *
                     assemble.hold.X_PartTool;
  // Along the mating vector, from as far off as if it went straight.
  const Vector3 direction = mating.mating_vector.normalized();
  const Vector3 way =
      mating.X_FixedHeld * strategy.X_HeldTip.translation() - strategy.X_FixedStart.translation();
  const double before = std::max(0.0, mating.mating_vector.norm() - way.dot(direction));
  const Pose above = geometry::Translation(-before * (X_WorldFixed.linear() * direction)) * start;
  return {.approach = {MoveAtSafeHeight{AtSafeHeight(workcell, above)},
                       MoveStraight{above, kFreePace}, MoveStraight{start, kFreePace}},
          .advance = {Clamp{mating.fixed, kClampForce}, FollowStrategy{strategy, mating.fixed}},
          .depart = {OpenGripper{OpenGripper::Release{mating.held, X_WorldHeld}},
                     Clamp{mating.fixed, 0}, MoveStraight{retreated, kFingersPace},
                     MoveStraight{AtSafeHeight(workcell, retreated), kFreePace}}};
}

}  // namespace assay::exec
