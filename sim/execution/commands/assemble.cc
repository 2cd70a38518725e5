#include "planner/geometry/pose.h"
#include "sim/execution/commands/action_commands.h"

namespace assay::execution {

StepCommands CommandsToMate(const domain::Problem& problem, const WorldModel& world,
                            const plan::Action& assemble, const plan::Certificate& certificate) {
  const domain::Workcell& workcell = *problem.workcell;
  const domain::Mating& mating = problem.mating(assemble.mating);
  const Pose X_WorldFixed = world.PartPose(mating.fixed);
  const Pose X_WorldHeld = X_WorldFixed * mating.X_FixedHeld;
  const Vector3 vector = X_WorldFixed.linear() * mating.mating_vector;
  const double travel = workcell.rules().guarded_travel;
  const double farther = plan::BeyondContact(problem, certificate);
  const Vector3 beyond = farther * vector.normalized();
  const Pace pace = MatingPace(farther + plan::DoubtOfContact(certificate, travel));
  const plan::ToolRoute route = plan::RouteOf(problem, assemble, nullptr, X_WorldFixed);
  const Pose& start = route.poised;
  const Pose& mated = route.to_work.back();
  const Pose& retreated = route.left();
  StepCommands commands = {
      .approach = {MoveAtSafeHeight{AtSafeHeight(workcell, start)}, MoveStraight{start, kFreePace}},
      .advance = {MoveStraight{geometry::Translation(beyond) * mated, pace, Guard{kResistance}}},
      .depart = {OpenGripper{OpenGripper::Release{mating.held, X_WorldHeld}},
                 MoveStraight{retreated, kFingersPace},
                 MoveStraight{AtSafeHeight(workcell, retreated), kFreePace}}};
  ClampFixed(problem, mating, commands);
  return commands;
}

}  // namespace assay::execution
