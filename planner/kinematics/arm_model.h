#pragma once

#include <map>
#include <string>
#include <vector>

#include "planner/kinematics/inverse/serial_chain.h"
#include "planner/kinematics/urdf_model.h"

namespace assay::kinematics {

// Values of revolute joints that do not move, in radians, by the names of the joints.
using LockedJoints = std::map<std::string, double>;

// Returns the model with these joints fixed. Throws InputError if the model has no such joint, or
// if a value is outside its limits.
RobotModel WithLocked(RobotModel model, const LockedJoints& locked);

// Returns the ways to lock one joint of an arm with seven joints between base and flange, at
// multiples of 30 degrees up to a right angle (or the middle of a range without any), the best
// first. Arms whose solutions can be told apart (ArmSolver) are best. Among them, those are better
// that are farther from singular postures, on average. An arm with six joints has one way, which
// locks nothing.
std::vector<LockedJoints> Lockings(const RobotModel& model, const std::string& base,
                                   const std::string& flange);

// Returns an arm as a base and six moving links, in one chain. Links that are fixed to each other
// become one link, with the shapes, meshes, masses and inertias of all. The base has the frame of
// `base`, and the last link that of `flange`. The other links have the frames of their joints.
// Empty names are found (SerialChain::FromModel). Throws InputError if the joints between base and
// flange are not six revolute ones, if other joints move, if a link that moves has neither a mass
// nor a collision shape, or if the flange's origin is not on axis 6. A link that moves and has no
// mass gets one from its collision shapes (DerivedInertial).
//
// Angles of the file within 1e-5 rad of a multiple of a right angle are taken as this multiple,
// because files round pi / 2 to 1.5708.
RobotModel ArmModel(const RobotModel& model, const std::string& base, const std::string& flange);

// Returns the axes of such a model. Throws InputError if the flange cannot move in all directions
// in any posture.
SerialChain MovableChain(const RobotModel& arm);

}  // namespace assay::kinematics
