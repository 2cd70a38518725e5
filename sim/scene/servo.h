#pragma once

#include "sim/scene/scene.h"

namespace assay::scene {

// The joint servos of the arm: position and velocity feedback with gravity compensation, as stiff
// as the arm's motors behind their gears. A load of 1.2 kg in the hand moves the tool by less than
// 0.05 mm.
class JointServo {
 public:
  explicit JointServo(const Scene& scene);

  // The servos follow (q, qd) in the next step: call before each Data::Step. The load in the hand
  // is not compensated.
  void Command(mujoco::Data& data, const JointVector& q, const JointVector& qd) const;

 private:
  ArmAddresses arm_;
  JointVector lag_ = JointVector::Zero();  // damping over stiffness of each joint, seconds
};

}  // namespace assay::scene
