#include "sim/scene/servo.h"

#include "sim/scene/servo_gains.h"

namespace assay::scene {

JointServo::JointServo(const Scene& scene) : arm_(scene.arm()) {
  for (std::size_t i = 0; i < kServoGains.size(); ++i) {
    lag_[static_cast<Eigen::Index>(i)] = kServoGains[i].damping / kServoGains[i].stiffness;
  }
}

// A joint's damping is passive in the engine, which integrates it implicitly: the velocity that is
// wanted comes in as an offset of the position, so that it does not lag.
void JointServo::Command(mujoco::Data& data, const JointVector& q, const JointVector& qd) const {
  for (std::size_t i = 0; i < kServoGains.size(); ++i) {
    const auto j = static_cast<Eigen::Index>(i);
    data.ctrl()[arm_.ctrl[i]] = q[j] + lag_[j] * qd[j];
    data.qfrc_applied()[arm_.dof[i]] = data.qfrc_bias()[arm_.dof[i]];
  }
}

}  // namespace assay::scene
