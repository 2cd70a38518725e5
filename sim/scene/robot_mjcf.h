#pragma once

#include <string>

#include "planner/domain/workcell/workcell.h"
#include "sim/scene/xml_element.h"

namespace assay::scene {

// All names here begin with the robot's prefix.

// The class of the robot's shapes for collision, which says what they touch.
std::string CollisionClass(const domain::Robot& robot);

// Adds arm and gripper under `worldbody`: links with their inertias and shapes of their class for
// collision. Sites "tool" and "wrist" (the flange) are on the hand.
struct GripperRules {
  double grip_force = 0;    // newtons
  double pad_friction = 0;  // of the pads against whatever they touch
  // Tiles along each side of a pad. The engine presses on the corners of each patch alone: of one
  // patch as large as the pad these would bear nearly twice the torsion of an even pressure, of
  // two by two tiles an eighth more.
  int pad_tiles = 2;
};
void AddRobot(const domain::Robot& robot, const GripperRules& rules, XmlElement& worldbody);

// Adds what couples the fingers, under `equality`.
void AddFingerCoupling(const domain::Robot& robot, XmlElement& equality);

// Adds the joint servos "arm/JOINT" and the finger servos "gripper/finger_left" and
// "gripper/finger_right", whose controls are joint values.
void AddServos(const domain::Robot& robot, const GripperRules& rules, XmlElement& actuator);

// Adds the force and torque sensors "wrist/force" and "wrist/torque".
void AddWristSensors(const domain::Robot& robot, XmlElement& sensor);

}  // namespace assay::scene
