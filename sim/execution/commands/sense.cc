#include "planner/uncertainty/error_sets/sensing.h"
#include "sim/execution/commands/action_commands.h"

namespace assay::execution {
namespace {

// Returns the coordinates that the planner expects to be taken from the sensor. They follow from
// what is known before the look, which is in the step's certificate. Without a certificate all
// measured coordinates are taken.
Look::Takes TakesOf(const domain::Problem& problem, const plan::Action& sense,
                    const plan::Certificate& certificate) {
  constexpr Interval kUnknown = {-1e9, 1e9};
  const domain::SensorModel& sensor =
      *problem.workcell->uncertainty_operations().FindSensor(sense.sensor);
  plan::ErrorSet known = {
      .part = sense.part, .x = kUnknown, .y = kUnknown, .z = kUnknown, .theta = kUnknown};
  for (const plan::ErrorSet& set : certificate.before) {
    if (set.part == sense.part) known = set;
  }
  return {.x = uncertainty::TakesOver(known.x, sensor.x),
          .y = uncertainty::TakesOver(known.y, sensor.y),
          .z = uncertainty::TakesOver(known.z, sensor.z),
          .yaw = uncertainty::TakesOver(known.theta, sensor.theta)};
}

}  // namespace

StepCommands CommandsToLook(const domain::Problem& problem, const plan::Action& sense,
                            const plan::Certificate& certificate) {
  return {.approach = {MoveAtSafeHeight{plan::HomeTool(*problem.workcell)}},
          .act = {Look{sense.part, sense.sensor, TakesOf(problem, sense, certificate)}}};
}

}  // namespace assay::execution
