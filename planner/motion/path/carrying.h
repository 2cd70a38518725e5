#pragma once

#include "planner/motion/path/joint_trajectory.h"

namespace assay::motion {

// The trajectory, slowed down evenly as far as a part in the hand asks for it
// (planner/plan/data/carrying.h). `p_ToolCenter`: its centre of mass.
JointTrajectory Carrying(const JointTrajectory& trajectory, const domain::Workcell& workcell,
                         const geometry::Vector3& p_ToolCenter);

}  // namespace assay::motion
