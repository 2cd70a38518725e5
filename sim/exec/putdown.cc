#include "sim/exec/action_commands.h"

namespace assay::exec {

StepCommands CommandsFor(const domain::Problem& problem, const WorldModel&,
                         const plan::Putdown& putdown, const plan::Certificate& certificate) {
  const domain::Workcell& workcell = *problem.workcell;
  const double travel = workcell.rules().guarded_travel;
  const Pose placed = putdown.to.X_WorldPart * putdown.hold.X_PartTool;
  const Pose lowest = geometry::Translation(0, 0, -travel) * placed;
  const Pose retreated = Retreated(workcell, placed);
  return {.approach = {MoveAtSafeHeight{AtSafeHeight(workcell, placed)}},
          .advance = {MoveStraight{
              lowest, LandingPace(travel + plan::DoubtOfContact(certificate, travel)),
              Guard{kResistance}}},
          .depart = {OpenGripper{OpenGripper::Release{putdown.part, putdown.to.X_WorldPart}},
                     MoveStraight{retreated, kFingersPace},
                     MoveStraight{AtSafeHeight(workcell, retreated), kFreePace}},
          .withdraw = {MoveStraight{AtSafeHeight(workcell, placed), kFreePace}}};
}

}  // namespace assay::exec
