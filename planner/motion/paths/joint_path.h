#pragma once

#include <vector>

#include "planner/kinematics/arm.h"

namespace assay::motion {

// A path of postures. The arm goes straight in joint space from each posture to the next.
using JointPath = std::vector<kinematics::JointVector>;

}  // namespace assay::motion
