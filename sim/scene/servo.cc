#include "sim/scene/servo.h"

#include <algorithm>
#include <vector>

namespace assay::scene {

JointServo::JointServo(const Scene& scene)
    : arm_(scene.arm()), hand_(scene.hand()), servos_(scene.servos()), efforts_(scene.efforts()) {}

// The engine integrates a joint's damping implicitly, as a passive force against any velocity. The
// wanted velocity is therefore added as an offset of the commanded position, so that the joint does
// not lag.
void JointServo::Command(mujoco::Data& data, const JointState& state, const JointVector& qdd,
                         const Load& load) const {
  std::vector<double> qacc(data.qvel().size());
  std::vector<double> force(data.qvel().size());
  for (std::size_t i = 0; i < servos_.size(); ++i) {
    qacc[arm_.dof[i]] = qdd[static_cast<Eigen::Index>(i)];
  }
  data.MultiplyByInertia(qacc, force);
  for (std::size_t i = 0; i < servos_.size(); ++i) {
    const auto j = static_cast<Eigen::Index>(i);
    const int dof = arm_.dof[i];
    data.ctrl()[arm_.ctrl[i]] =
        state.q[j] + servos_[i].damping / servos_[i].stiffness * state.qd[j];
    data.qfrc_applied()[dof] = data.qfrc_bias()[dof] + force[dof];
  }
  if (!load.force.isZero()) data.AddForce(hand_, load.at, -load.force);
  LimitTorques(data);
}

// The torque of a motor is the sum of the torques that are applied, of the position's feedback and
// of the damping.
void JointServo::LimitTorques(mujoco::Data& data) const {
  for (std::size_t i = 0; i < servos_.size(); ++i) {
    const double effort = efforts_[static_cast<Eigen::Index>(i)];
    if (effort == 0) continue;
    const int dof = arm_.dof[i];
    const double feedback =
        servos_[i].stiffness * (data.ctrl()[arm_.ctrl[i]] - data.qpos()[arm_.qpos[i]]) -
        servos_[i].damping * data.qvel()[dof];
    const double torque = data.qfrc_applied()[dof] + feedback;
    data.qfrc_applied()[dof] -= torque - std::clamp(torque, -effort, effort);
  }
}

}  // namespace assay::scene
