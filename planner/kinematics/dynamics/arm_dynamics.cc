#include "planner/kinematics/dynamics/arm_dynamics.h"

#include <vector>

#include "planner/kinematics/fixed_links.h"

namespace assay::kinematics {
namespace {

Inertial Massless() { return {.inertia = Matrix3::Zero()}; }

// Returns a gripper at joint values 0 as one body in the flange's frame.
Inertial InertialOf(const RobotModel& gripper) {
  Inertial whole = Massless();
  std::vector<Pose> X_FlangeLink(gripper.links.size(), Pose::Identity());
  for (std::size_t i = 0; i < gripper.links.size(); ++i) {
    if (i > 0) {
      const Joint& joint = gripper.joints[i - 1];
      X_FlangeLink[i] =
          X_FlangeLink[static_cast<std::size_t>(joint.parent.index())] * joint.X_ParentChild(0);
    }
    const auto& inertial = gripper.links[i].inertial;
    if (inertial) whole = Joined(whole, Moved(X_FlangeLink[i], *inertial));
  }
  return whole;
}

// The velocity and the acceleration of a link, and of a point on it, in the base's frame.
struct LinkMotion {
  Vector3 point = Vector3::Zero();
  Vector3 acceleration = Vector3::Zero();  // of the point, m/s^2
  Vector3 omega = Vector3::Zero();         // rad/s
  Vector3 alpha = Vector3::Zero();         // rad/s^2

  Vector3 AccelerationAt(const Vector3& p) const {
    const Vector3 r = p - point;
    return acceleration + alpha.cross(r) + omega.cross(omega.cross(r));
  }
};

// A force, and a torque about the base's origin.
struct BaseWrench {
  Vector3 force = Vector3::Zero();
  Vector3 torque = Vector3::Zero();
};

BaseWrench WrenchToMove(const Inertial& body, const Pose& X_BaseLink, const LinkMotion& motion) {
  const Pose X_BaseCenter = X_BaseLink * body.X_LinkCenter;
  const Vector3 center = X_BaseCenter.translation();
  const Matrix3 inertia = X_BaseCenter.linear() * body.inertia * X_BaseCenter.linear().transpose();
  const Vector3 force = body.mass * motion.AccelerationAt(center);
  return {force, center.cross(force) + inertia * motion.alpha +
                     motion.omega.cross(inertia * motion.omega)};
}

}  // namespace

ArmDynamics::ArmDynamics(const Arm& arm, const Gripper& gripper, const Vector3& gravity)
    : arm_(&arm), gravity_(gravity) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    bodies_[i] = arm.model().links[i].inertial.value_or(Massless());
  }
  bodies_.back() = Joined(bodies_.back(), InertialOf(gripper.model()));
}

ArmDynamics ArmDynamics::Carrying(const Inertial& body) const {
  ArmDynamics carrying = *this;
  carrying.bodies_.back() = Joined(bodies_.back(), body);
  return carrying;
}

// A base that accelerates upward takes the place of gravity.
JointVector ArmDynamics::Torques(const JointMotion& motion) const {
  const std::array<Pose, 7> X_BaseLink = arm_->LinkPoses(motion.q);
  std::array<Vector3, 6> axes;
  std::array<BaseWrench, 6> wrenches;
  LinkMotion link{.acceleration = -gravity_};
  for (std::size_t i = 0; i < 6; ++i) {
    const auto j = static_cast<Eigen::Index>(i);
    const Joint& joint = arm_->model().joints[i];
    const Pose& X_BaseThis = X_BaseLink[i + 1];
    axes[i] = X_BaseThis.linear() * joint.axis;
    const Vector3 turning = motion.qd[j] * axes[i];
    link = {.point = X_BaseThis.translation(),
            .acceleration = link.AccelerationAt(X_BaseThis.translation()),
            .omega = link.omega + turning,
            .alpha = link.alpha + motion.qdd[j] * axes[i] + link.omega.cross(turning)};
    wrenches[i] = WrenchToMove(bodies_[i + 1], X_BaseThis, link);
  }
  JointVector torques;
  BaseWrench beyond;
  for (std::size_t i = 6; i-- > 0;) {
    beyond.force += wrenches[i].force;
    beyond.torque += wrenches[i].torque;
    const Vector3& p = X_BaseLink[i + 1].translation();
    torques[static_cast<Eigen::Index>(i)] = axes[i].dot(beyond.torque - p.cross(beyond.force));
  }
  return torques;
}

}  // namespace assay::kinematics
