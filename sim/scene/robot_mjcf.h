#pragma once

#include <string>

#include "planner/domain/workcell/workcell.h"
#include "sim/scene/xml_element.h"

namespace assay::scene {

// All names that these functions write begin with the robot's prefix.

// Returns the name of the class of the robot's collision shapes. The class defines what they touch.
std::string CollisionClass(const domain::Robot& robot);

// Settings for the way in which a gripper holds parts.
struct GripperRules {
  double grip_force = 0;     // newtons
  double pad_friction = 0;   // coefficient of friction between the pads and whatever they touch
  double lightest_part = 1;  // kg, the least mass of the parts that the pads may hold
  // The number of tiles along each side of a pad. The engine presses only on the corners of each
  // tile. The corners of a single tile would bear nearly twice the torsion of an even pressure; the
  // corners of two by two tiles bear an eighth more than an even pressure.
  int pad_tiles = 2;
};
// Adds arm and gripper under `worldbody`: links with their inertias and their shapes for collision.
// Hulls of meshes are added under `asset`. The sites "tool" and "wrist" (the flange) are on the
// hand. The inertias of the joints are those for dampers (AddDampers) and a timestep in seconds.
void AddRobot(const domain::Robot& robot, const GripperRules& rules, double timestep,
              XmlElement& asset, XmlElement& worldbody);

// Adds the dampers of the joints and of the fingers, with the names of their joints.
void AddDampers(const domain::Robot& robot, const GripperRules& rules, XmlElement& tendon);

// Adds the constraint that couples the fingers under `equality`.
void AddFingerCoupling(const domain::Robot& robot, XmlElement& equality);

// Adds the joint servos "arm/JOINT" and the finger servos "gripper/finger_left" and
// "gripper/finger_right", whose controls are joint values.
void AddServos(const domain::Robot& robot, const GripperRules& rules, XmlElement& actuator);

// Adds the force and torque sensors "wrist/force" and "wrist/torque".
void AddWristSensors(const domain::Robot& robot, XmlElement& sensor);

}  // namespace assay::scene
