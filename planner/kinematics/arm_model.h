#pragma once

#include <string>

#include "planner/kinematics/inverse/serial_chain.h"
#include "planner/kinematics/urdf_model.h"

namespace assay::kinematics {

// Returns an arm as a base and six moving links, in one chain. Links that are fixed to each other
// become one link, with the shapes, meshes, masses and inertias of all. The base has the frame of
// `base`, and the last link that of `flange`. The other links have the frames of their joints.
// Empty names are found (SerialChain::FromModel). Throws InputError if the joints between base and
// flange are not six revolute ones, if other joints move, or if the flange's origin is not on
// axis 6.
//
// Angles of the file within 1e-5 rad of a multiple of a right angle are taken as this multiple,
// because files round pi / 2 to 1.5708.
RobotModel ArmModel(const RobotModel& model, const std::string& base, const std::string& flange);

// Returns the axes of such a model. Throws InputError if the flange cannot move in all directions
// in any posture.
SerialChain MovableChain(const RobotModel& arm);

}  // namespace assay::kinematics
