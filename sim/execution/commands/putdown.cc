#include "planner/geometry/pose.h"
#include "sim/execution/commands/action_commands.h"

namespace assay::execution {

StepCommands CommandsToPutDown(const domain::Problem& problem, const plan::Action& putdown,
                               const plan::Certificate& certificate) {
  const domain::Workcell& workcell = *problem.workcell;
  const double travel = workcell.rules().guarded_travel;
  const plan::ToolRoute route = plan::RouteOf(problem, putdown, nullptr, putdown.place.X_WorldPart);
  const Pose& placed = route.to_work.back();
  const double beyond = plan::BeyondContact(problem, certificate);
  const Pose lowest = geometry::Translation(0, 0, -beyond) * placed;
  const Pose& retreated = route.left();
  return {.approach = {MoveAtSafeHeight{AtSafeHeight(workcell, placed)}},
          .advance = {MoveStraight{lowest,
                                   LandingPace(beyond + plan::DoubtOfContact(certificate, travel)),
                                   Guard{kResistance}}},
          .depart = {OpenGripper{OpenGripper::Release{putdown.part, putdown.place.X_WorldPart}},
                     MoveStraight{retreated, kFingersPace},
                     MoveStraight{AtSafeHeight(workcell, retreated), kFreePace}},
          .withdraw = {MoveStraight{AtSafeHeight(workcell, placed), kFreePace}}};
}

}  // namespace assay::execution
