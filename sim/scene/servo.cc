#include "sim/scene/servo.h"

#include <vector>

#include "sim/scene/servo_gains.h"

namespace assay::scene {

JointServo::JointServo(const Scene& scene) : arm_(scene.arm()), hand_(scene.hand()) {
  for (std::size_t i = 0; i < kServoGains.size(); ++i) {
    lag_[static_cast<Eigen::Index>(i)] = kServoGains[i].damping / kServoGains[i].stiffness;
  }
}

// The engine integrates a joint's damping implicitly, as a passive force against any velocity. The
// wanted velocity is therefore added as an offset of the commanded position, so that the joint does
// not lag.
void JointServo::Command(mujoco::Data& data, const JointState& state, const JointVector& qdd,
                         const Load& load) const {
  std::vector<double> qacc(data.qvel().size());
  std::vector<double> force(data.qvel().size());
  for (std::size_t i = 0; i < kServoGains.size(); ++i) {
    qacc[arm_.dof[i]] = qdd[static_cast<Eigen::Index>(i)];
  }
  data.MultiplyByInertia(qacc, force);
  for (std::size_t i = 0; i < kServoGains.size(); ++i) {
    const auto j = static_cast<Eigen::Index>(i);
    const int dof = arm_.dof[i];
    data.ctrl()[arm_.ctrl[i]] = state.q[j] + lag_[j] * state.qd[j];
    data.qfrc_applied()[dof] = data.qfrc_bias()[dof] + force[dof];
  }
  if (!load.force.isZero()) data.AddForce(hand_, load.at, -load.force);
}

}  // namespace assay::scene
