#pragma once

#include <optional>

#include "planner/motion/paths/joint_trajectory.h"

namespace assay::motion {

// Returns the trajectory, slowed down evenly until the motors of the arm have the torques for it
// (the efforts in the URDF file; 0: unknown, and not limited). `held` is the inertia of a part in
// the hand, in the tool's frame. Returns nothing if the motors cannot carry the weight of the arm
// and the part somewhere on the way, or only at less than a twentieth of the speed.
std::optional<JointTrajectory> WithinTorques(const JointTrajectory& trajectory,
                                             const domain::Robot& robot,
                                             const std::optional<kinematics::Inertial>& held);

}  // namespace assay::motion
