#pragma once

#include "sim/scene/scene.h"

namespace assay::scene {

using kinematics::JointState;

// What hangs in the hand: it pulls at a point (world) with a force, newtons.
struct Load {
  Vector3 force = Vector3::Zero();
  Vector3 at = Vector3::Zero();
};

// The joint servos of the arm: position and velocity feedback, as stiff as the arm's motors behind
// their gears, on top of the torques that its dynamics ask for (computed torque). A load of 1.2 kg
// of which the servos are not told moves the tool by less than 0.05 mm.
class JointServo {
 public:
  explicit JointServo(const Scene& scene);

  // The servos follow a state and an acceleration (rad/s^2) in the next step and carry the load:
  // call before each Data::Step.
  void Command(mujoco::Data& data, const JointState& state,
               const JointVector& qdd = JointVector::Zero(), const Load& load = {}) const;

 private:
  ArmAddresses arm_;
  mujoco::BodyId hand_;
  JointVector lag_ = JointVector::Zero();  // damping over stiffness of each joint, seconds
};

}  // namespace assay::scene
