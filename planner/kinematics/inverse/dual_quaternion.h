#pragma once

#include "planner/kinematics/inverse/joint_axis.h"

namespace assay::kinematics {

// The coefficients of a dual quaternion: w, x, y, z of the real part, then of the dual part.
using DualQuaternion = Eigen::Matrix<double, 8, 1>;

// Returns the direction and moment of the line. The turn by an angle about it is
// cos(angle / 2) + sin(angle / 2) * LineOf(axis).
DualQuaternion LineOf(const JointAxis& axis);

// Returns one of the two unit dual quaternions of a motion.
DualQuaternion DualQuaternionOf(const Pose& motion);

DualQuaternion Product(const DualQuaternion& a, const DualQuaternion& b);

}  // namespace assay::kinematics
