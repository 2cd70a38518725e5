#pragma once

#include "planner/geometry/coordinates.h"

namespace assay::geometry {

Pose Translation(const Vector3& p);
Pose Translation(double x, double y, double z);
Pose RotationX(double angle);
Pose RotationY(double angle);
Pose RotationZ(double angle);

// Returns the pose with these axes as columns and this origin. The axes must be orthonormal and
// right-handed to within 1e-6 (checked), and are then made exactly so.
Pose PoseFromColumns(const Vector3& x, const Vector3& y, const Vector3& z, const Vector3& origin);

// Returns the least angle in [0, pi] that turns R_A into R_B.
double AngleBetween(const Matrix3& R_A, const Matrix3& R_B);

}  // namespace assay::geometry
