#pragma once

#include "sim/scene/scene.h"

namespace assay::scene {

using kinematics::JointState;

// The load of a held part: a force, newtons, that pulls at a point, metres, both in the world
// frame.
struct Load {
  Vector3 force = Vector3::Zero();
  Vector3 at = Vector3::Zero();
};

// The joint servos of the arm, which use computed torque control. They apply the torques of the
// arm's dynamics and add position and velocity feedback. The torque of a motor does not exceed its
// limit, apart from the damping of the change of velocity within one timestep. With the
// gains of the Puma 762, a load of 1.2 kg that the servos do not know of moves the tool by less
// than 0.05 mm.
class JointServo {
 public:
  explicit JointServo(const Scene& scene);

  // Commands the servos to reach a state with an acceleration (rad/s^2) in the next timestep and to
  // carry the load. Call it before each Data::Step.
  void Command(mujoco::Data& data, const JointState& state,
               const JointVector& qdd = JointVector::Zero(), const Load& load = {}) const;

 private:
  void LimitTorques(mujoco::Data& data) const;

  ArmAddresses arm_;
  mujoco::BodyId hand_;
  kinematics::ArmServos servos_;
  JointVector efforts_;  // N m; 0 for unknown
};

}  // namespace assay::scene
