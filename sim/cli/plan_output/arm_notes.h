#pragma once

#include <string>

#include "planner/kinematics/urdf_model.h"

namespace assay::cli {

// Returns sentences about what the program made of an arm's file: the convex pieces of collision
// meshes, and inertias that it derived. Empty if there is nothing to tell.
std::string ArmNotes(const kinematics::RobotModel& arm);

}  // namespace assay::cli
