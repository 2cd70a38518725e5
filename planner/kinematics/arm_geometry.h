#pragma once

#include <optional>

#include "planner/kinematics/urdf_model.h"

namespace assay::kinematics {

// The lengths of the Denavit-Hartenberg table, in metres: alpha = (-90, 0, 90, -90, 90, 0) degrees,
// a = (0, a2, a3, 0, 0, 0), d = (0, d2, 0, d4, 0, d6).
struct ArmGeometry {
  double a2 = 0;  // shoulder axis to elbow axis, > 0
  double a3 = 0;  // elbow axis to the line of axis 4
  double d2 = 0;  // offset of the arm's plane from axis 1
  double d4 = 0;  // elbow to wrist centre, > 0
  double d6 = 0;  // wrist centre to flange
};

// Returns the lengths of an arm, a chain of six revolute joints, or none if it does not satisfy Lee
// and Ziegler's convention. At joint values 0, axes 1, 4, 6 must point along the base's z, and axes
// 2, 3, 5 along its y. Axes 1 and 2 must meet in the base's origin, and axes 4, 5, 6 in one point.
// The frame of the last link, the flange, must have the base's orientation and its origin on
// axis 6.
std::optional<ArmGeometry> GeometryOf(const RobotModel& arm);

}  // namespace assay::kinematics
