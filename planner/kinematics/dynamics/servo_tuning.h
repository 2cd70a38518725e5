#pragma once

#include <array>

#include "planner/kinematics/arm.h"
#include "planner/kinematics/dynamics/servo_gains.h"
#include "planner/kinematics/grippers/gripper.h"

namespace assay::kinematics {

// What the servo of one joint has to move.
struct JointLoad {
  double lever = 0;    // the greatest distance of the tool from the joint's axis, m
  double inertia = 0;  // the greatest inertia about the axis, without the motor's, kg m^2
  double weight = 0;   // the greatest torque that carries the weight of arm and gripper, N m
};

// Returns the loads of the joints in random postures within the limits, of an arm that stands
// upright.
std::array<JointLoad, 6> LoadsOf(const Arm& arm, const Gripper& gripper);

// Returns servo gains for joints with these loads:
// - A force at the tool turns a joint so little that the tool yields by at most 1.3 micrometres per
//   newton because of this joint. Parts in the hand reach up to 0.25 m from the axes of the wrist,
//   so no lever counts as less.
// - The armature is so great that no vibration of the arm is faster than 200 rad/s, in any posture.
//   Faster ones would need shorter timesteps. (The square of the fastest frequency is the greatest
//   eigenvalue of the stiffness divided by the inertia, and the inertia is at least the armature.)
// - The damping is critical where a joint has its greatest inertia.
//
// At the tool, all arms then have nearly the same stiffness and nearly the same inertia of the
// motors, so that one law of hybrid control serves all of them.
ArmServos TunedServos(const std::array<JointLoad, 6>& loads);

}  // namespace assay::kinematics
