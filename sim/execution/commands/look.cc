#include <cmath>

#include "planner/geometry/pose.h"
#include "sim/execution/commands/run.h"

namespace assay::execution {
namespace {

// Returns the angle about the world's vertical from one pose to another that is nearly as upright.
double YawBetween(const Pose& from, const Pose& to) {
  const geometry::Matrix3 turn = to.linear() * from.linear().transpose();
  return std::atan2(turn(1, 0) - turn(0, 1), turn(0, 0) + turn(1, 1));
}

// Returns the pose turned about the vertical through its own origin, then displaced.
Pose Moved(const Pose& pose, double yaw, const Vector3& displacement) {
  Pose moved = geometry::RotationZ(yaw) * pose;
  moved.translation() = pose.translation() + displacement;
  return moved;
}

std::optional<Pose> Measured(const Look& look, const TrueAndBelieved& part, Execution& execution) {
  if (execution.options().sensor != nullptr) {
    return execution.options().sensor->Measure(execution.data(), look.part, part.believed);
  }
  const auto error = execution.options().noise.Sensed(execution.step());
  return Moved(part.truth, -error.yaw, -error.displacement);
}

Pose Updated(const Pose& believed, const Pose& measured, const Look::Takes& takes) {
  Vector3 displacement = measured.translation() - believed.translation();
  if (!takes.x) displacement.x() = 0;
  if (!takes.y) displacement.y() = 0;
  if (!takes.z) displacement.z() = 0;
  return Moved(believed, takes.yaw ? YawBetween(believed, measured) : 0, displacement);
}

}  // namespace

Progress Run(const Look& look, std::span<const Command>, Execution& execution) {
  const TrueAndBelieved part = execution.Now().parts[look.part.index()];
  const std::optional<Pose> measured = Measured(look, part, execution);
  const Pose believed = measured ? Updated(part.believed, *measured, look.takes) : part.believed;
  execution.world().Believe(look.part, believed);
  execution.trace().events.push_back(LookRecord{.time = execution.data().time(),
                                                .part = look.part,
                                                .sensor = look.sensor,
                                                .found = measured.has_value(),
                                                .measured = measured.value_or(part.believed),
                                                .before = part,
                                                .believed = believed});
  if (measured) return std::nullopt;
  return Failure{TrialOutcome::kNotFound,
                 look.sensor + " does not find " + execution.problem().part(look.part).name};
}

}  // namespace assay::execution
