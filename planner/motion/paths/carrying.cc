#include "planner/motion/paths/carrying.h"

#include <algorithm>
#include <cmath>

#include "planner/motion/paths/straight_line.h"
#include "planner/plan/certificates/carrying.h"

namespace assay::motion {
namespace {

constexpr double kInstant = 1e-3;  // seconds between poses whose differences are accelerations

Vector3 RotationVector(const geometry::Matrix3& R) {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

// Returns the ratio of the part's accelerations to their limits: 1 where they are equal.
double Demand(const JointMotion& motion, const domain::Workcell& workcell,
              const Vector3& p_ToolCenter) {
  const auto pose_at = [&](double t) {
    return ToolAt(workcell, motion.q + t * motion.qd + t * t / 2 * motion.qdd);
  };
  const Pose before = pose_at(-kInstant);
  const Pose now = pose_at(0);
  const Pose after = pose_at(kInstant);
  const Vector3 acceleration =
      (after * p_ToolCenter - 2 * (now * p_ToolCenter) + before * p_ToolCenter) /
      (kInstant * kInstant);
  const Vector3 ahead = RotationVector(now.linear().transpose() * after.linear());
  const Vector3 back = RotationVector(now.linear().transpose() * before.linear());
  const double turn = (ahead + back).norm() / (kInstant * kInstant) +
                      ((ahead - back) / (2 * kInstant)).squaredNorm();
  return std::max(acceleration.norm() / plan::kCarryingAcceleration, turn / plan::kCarryingTurn);
}

}  // namespace

JointTrajectory Carrying(const JointTrajectory& trajectory, const domain::Workcell& workcell,
                         const geometry::Vector3& p_ToolCenter) {
  double greatest = 1;
  for (const JointMotion& motion : trajectory.Instants()) {
    greatest = std::max(greatest, Demand(motion, workcell, p_ToolCenter));
  }
  // Accelerations are proportional to the square of speed.
  return trajectory.SlowedDown(std::sqrt(greatest));
}

}  // namespace assay::motion
