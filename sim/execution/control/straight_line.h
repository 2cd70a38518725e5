#pragma once

#include "planner/motion/paths/joint_trajectory.h"
#include "planner/motion/paths/straight_line.h"
#include "sim/execution/control/pace.h"

namespace assay::execution {

using kinematics::JointVector;
using motion::FollowLine;
using motion::JointRates;
using motion::JointTrajectory;
using motion::LinePath;
using motion::LineResult;
using motion::ToolAt;

// Returns the path with times: from rest to rest, as fast as the pace and the joints' rates allow.
// Speed limits are found at each point of the path and acceleration limits between the points. One
// pass forward and one backward then make them compatible (Bobrow, Dubowsky and Gibson 1985, with
// limits of rates in place of torques). Half of each joint's acceleration is reserved for the
// curvature of its path.
JointTrajectory WithTimes(const LinePath& path, const Pace& pace, const JointRates& rates);

}  // namespace assay::execution
