#pragma once

#include "planner/domain/workcell.h"
#include "sim/scene/xml_element.h"

namespace assay::scene {

// Adds arm and gripper under `worldbody`: links with their inertias; the arm's links are seen but
// do not collide, hand and fingers do. Sites "tool" and "wrist" (the flange) are on the hand.
// `pad_friction` is that of the pads against whatever they touch.
void AddRobot(const domain::Workcell& workcell, double pad_friction, XmlElement& worldbody);

// Adds what couples the fingers, under `equality`.
void AddFingerCoupling(XmlElement& equality);

// Adds the joint servos "arm/JOINT" and the finger servos "gripper/finger_left" and
// "gripper/finger_right", whose controls are joint values.
void AddServos(const domain::Workcell& workcell, XmlElement& actuator);

// Adds the force and torque sensors "wrist/force" and "wrist/torque".
void AddWristSensors(XmlElement& sensor);

}  // namespace assay::scene
