#pragma once

#include "planner/motion/paths/joint_trajectory.h"

namespace assay::motion {

// Returns the trajectory, slowed down evenly until a part in the hand keeps to its limits
// (planner/plan/certificates/carrying.h). `p_ToolCenter` is the part's centre of mass.
JointTrajectory Carrying(const JointTrajectory& trajectory, const domain::Workcell& workcell,
                         const geometry::Vector3& p_ToolCenter);

}  // namespace assay::motion
