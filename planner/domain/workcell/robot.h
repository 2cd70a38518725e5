#pragma once

#include <memory>
#include <string>

#include "planner/base/id.h"
#include "planner/geometry/coordinates.h"
#include "planner/kinematics/arm.h"
#include "planner/kinematics/dynamics/servo_gains.h"
#include "planner/kinematics/grippers/gripper.h"

namespace assay::domain {

using RobotId = Id<struct RobotTag>;

// An arm with its gripper, and where it stands in a workcell.
struct Robot {
  std::string name;  // empty where the workcell has only one
  std::shared_ptr<const kinematics::Arm> arm;
  std::shared_ptr<const kinematics::Gripper> gripper;
  kinematics::GripperInFile gripper_in_file = {};
  geometry::Pose X_WorldBase = geometry::Pose::Identity();
  kinematics::JointVector home = kinematics::JointVector::Zero();  // where the arm starts and ends
  kinematics::JointVector joint_acceleration =
      kinematics::JointVector::Zero();  // the greatest of each joint, rad/s^2
  kinematics::ArmServos servos = {};

  // Returns the prefix that distinguishes names that belong to this robot from those of other
  // robots: "left/", or nothing if it is the only robot.
  std::string Prefix() const { return name.empty() ? "" : name + "/"; }
};

}  // namespace assay::domain
