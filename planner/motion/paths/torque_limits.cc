#include "planner/motion/paths/torque_limits.h"

#include <algorithm>
#include <cmath>

#include "planner/kinematics/fixed_links.h"

namespace assay::motion {
namespace {

using kinematics::ArmDynamics;

// The share of the torques that a motion may use. The servos need the rest.
constexpr double kShare = 0.95;
// The least speed, as a share of the speed that is asked for. Motors that need a lower one are too
// weak.
constexpr double kLeastSpeed = 0.05;

ArmDynamics DynamicsOf(const domain::Robot& robot,
                       const std::optional<kinematics::Inertial>& held) {
  const Vector3 gravity =
      robot.X_WorldBase.linear().transpose() * Vector3(0, 0, -kinematics::kGravity);
  const ArmDynamics empty(*robot.arm, *robot.gripper, gravity);
  if (!held) return empty;
  return empty.Carrying(kinematics::Moved(robot.gripper->X_FlangeTool(), *held));
}

// Returns the square of the factor of speed at which the torque of a joint reaches its limit.
// `still` is the torque without motion. The rest of the torque is proportional to the square of
// speed.
double SquaredSpeed(double torque, double still, double limit) {
  if (std::abs(still) > limit) return 0;
  const double moving = torque - still;
  if (moving == 0) return 1;
  return (limit - (moving > 0 ? still : -still)) / std::abs(moving);
}

}  // namespace

std::optional<JointTrajectory> WithinTorques(const JointTrajectory& trajectory,
                                             const domain::Robot& robot,
                                             const std::optional<kinematics::Inertial>& held) {
  const ArmDynamics dynamics = DynamicsOf(robot, held);
  double squared_speed = 1;
  for (const JointMotion& motion : trajectory.Instants()) {
    const JointVector still = dynamics.Torques({.q = motion.q});
    JointVector torques = dynamics.Torques(motion);
    for (int j = 0; j < 6; ++j) {
      const auto i = static_cast<std::size_t>(j);
      const double effort = robot.arm->limits()[i].effort;
      if (effort == 0) continue;
      torques[j] += robot.servos[i].armature * motion.qdd[j];
      squared_speed = std::min(squared_speed, SquaredSpeed(torques[j], still[j], kShare * effort));
    }
  }
  if (squared_speed < kLeastSpeed * kLeastSpeed) return std::nullopt;
  return trajectory.SlowedDown(1 / std::sqrt(squared_speed));
}

}  // namespace assay::motion
