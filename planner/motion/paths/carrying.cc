#include "planner/motion/paths/carrying.h"

#include <algorithm>
#include <cmath>

#include "planner/motion/paths/straight_line.h"
#include "planner/plan/certificates/carrying.h"

namespace assay::motion {
namespace {

constexpr double kInstant = 1e-3;      // seconds between poses whose differences are accelerations
constexpr double kTurnPerLook = 0.05;  // greatest turn of a joint between tested states, radians

JointVector AccelerationAt(const JointTrajectory::Knot& a, const JointTrajectory::Knot& b,
                           double share) {
  const double h = b.time - a.time;
  const JointVector slope = (b.state.q - a.state.q) / h;
  return ((6 - 12 * share) * slope - (4 - 6 * share) * a.state.qd - (2 - 6 * share) * b.state.qd) /
         h;
}

Vector3 RotationVector(const geometry::Matrix3& R) {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

// Returns the ratio of the part's accelerations to their limits: 1 where they are equal.
double Demand(const JointState& state, const JointVector& qdd, const domain::Workcell& workcell,
              const Vector3& p_ToolCenter) {
  const auto pose_at = [&](double t) {
    return ToolAt(workcell, state.q + t * state.qd + t * t / 2 * qdd);
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

int LooksAlong(const JointVector& from, const JointVector& to) {
  return 1 + static_cast<int>(std::ceil((to - from).cwiseAbs().maxCoeff() / kTurnPerLook));
}

}  // namespace

JointTrajectory Carrying(const JointTrajectory& trajectory, const domain::Workcell& workcell,
                         const geometry::Vector3& p_ToolCenter) {
  std::vector<JointTrajectory::Knot> knots = trajectory.knots();
  double greatest = 1;
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const JointTrajectory::Knot& a = knots[i];
    const JointTrajectory::Knot& b = knots[i + 1];
    const int looks = LooksAlong(a.state.q, b.state.q);
    for (int look = 0; look <= looks; ++look) {
      const double share = static_cast<double>(look) / looks;
      const JointState state = trajectory.At(a.time + share * (b.time - a.time));
      greatest =
          std::max(greatest, Demand(state, AccelerationAt(a, b, share), workcell, p_ToolCenter));
    }
  }
  // Accelerations are proportional to the square of speed.
  const double slower = std::sqrt(greatest);
  for (JointTrajectory::Knot& knot : knots) {
    knot.time *= slower;
    knot.state.qd /= slower;
  }
  return JointTrajectory(std::move(knots));
}

}  // namespace assay::motion
