#pragma once

#include <array>

#include "planner/kinematics/arm.h"
#include "planner/kinematics/grippers/gripper.h"

namespace assay::kinematics {

inline constexpr double kGravity = 9.81;  // m/s^2, the value in the engine

// The motion of an arm's joints at one instant, in rad, rad/s and rad/s^2.
struct JointMotion {
  JointVector q = JointVector::Zero();
  JointVector qd = JointVector::Zero();
  JointVector qdd = JointVector::Zero();
};

// The dynamics of an arm with a closed gripper, as rigid bodies without friction.
class ArmDynamics {
 public:
  // `gravity` is the acceleration of free fall in the base's frame, m/s^2.
  ArmDynamics(const Arm& arm, const Gripper& gripper, const Vector3& gravity);

  // Returns the dynamics with a body in the hand, whose inertia is given in the flange's frame.
  ArmDynamics Carrying(const Inertial& body) const;

  // Returns the torques at the joints that a motion needs, in N m. They do not include what the
  // inertia of the motors needs. The method is the recursive Newton-Euler algorithm (Luh, Walker
  // and Paul 1980).
  JointVector Torques(const JointMotion& motion) const;

 private:
  const Arm* arm_;
  Vector3 gravity_;
  std::array<Inertial, 7> bodies_;  // of the arm's links, the gripper with the last
};

}  // namespace assay::kinematics
