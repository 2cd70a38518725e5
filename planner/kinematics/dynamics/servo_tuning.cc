#include "planner/kinematics/dynamics/servo_tuning.h"

#include <algorithm>
#include <cmath>

#include "planner/base/random.h"
#include "planner/kinematics/dynamics/arm_dynamics.h"

namespace assay::kinematics {
namespace {

constexpr int kPostures = 1000;
constexpr double kCompliance = 1.3e-6;  // m/N at the tool, of each joint
constexpr double kLeastLever = 0.25;    // m
constexpr double kFrequency = 200;      // rad/s

JointVector RandomPosture(const Arm& arm, RandomStream& random) {
  JointVector q;
  for (int j = 0; j < 6; ++j) {
    const JointLimits& limits = arm.limits()[static_cast<std::size_t>(j)];
    q[j] = random.Uniform(limits.lower, limits.upper);
  }
  return q;
}

// Returns the distance of a point from the axis of joint i, in metres.
double Lever(const Arm& arm, std::size_t i, const std::array<Pose, 7>& X_BaseLink,
             const Vector3& p_Base) {
  const Pose& X_BaseThis = X_BaseLink[i + 1];
  const Vector3 axis = X_BaseThis.linear() * arm.model().joints[i].axis;
  return axis.cross(p_Base - X_BaseThis.translation()).norm();
}

}  // namespace

std::array<JointLoad, 6> LoadsOf(const Arm& arm, const Gripper& gripper) {
  const ArmDynamics weightless(arm, gripper, Vector3::Zero());
  const ArmDynamics upright(arm, gripper, Vector3(0, 0, -kGravity));
  RandomStream random(1, "servo tuning");
  std::array<JointLoad, 6> loads;
  for (int k = 0; k < kPostures; ++k) {
    const JointVector q = RandomPosture(arm, random);
    const auto X_BaseLink = arm.LinkPoses(q);
    const JointVector weight = upright.Torques({.q = q});
    const Vector3 tool = X_BaseLink.back() * gripper.X_FlangeTool().translation();
    for (std::size_t i = 0; i < loads.size(); ++i) {
      const auto j = static_cast<Eigen::Index>(i);
      const JointVector unit = JointVector::Unit(j);
      loads[i].lever = std::max(loads[i].lever, Lever(arm, i, X_BaseLink, tool));
      loads[i].weight = std::max(loads[i].weight, std::abs(weight[j]));
      loads[i].inertia = std::max(loads[i].inertia, weightless.Torques({.q = q, .qdd = unit})[j]);
    }
  }
  return loads;
}

ArmServos TunedServos(const std::array<JointLoad, 6>& loads) {
  ArmServos servos;
  for (std::size_t i = 0; i < servos.size(); ++i) {
    const double lever = std::max(loads[i].lever, kLeastLever);
    const double stiffness = lever * lever / kCompliance;
    const double armature = stiffness / (kFrequency * kFrequency);
    servos[i] = {.armature = armature,
                 .stiffness = stiffness,
                 .damping = 2 * std::sqrt(stiffness * (armature + loads[i].inertia))};
  }
  return servos;
}

}  // namespace assay::kinematics
