#pragma once

#include "planner/geometry/coordinates.h"

namespace assay::kinematics {

using geometry::Pose;
using geometry::Vector3;

// The line that a revolute joint turns about. Both vectors are in one frame, which the user names.
struct JointAxis {
  Vector3 direction = Vector3::UnitZ();  // unit vector
  Vector3 point = Vector3::Zero();       // any point of the line, metres
};

// Returns the turn about the axis by an angle in radians, as a motion of space.
Pose Turn(const JointAxis& axis, double angle);

// Returns the axis that a motion of space carries `axis` to.
JointAxis Moved(const Pose& motion, const JointAxis& axis);

// The circle on which a point moves when it is turned about an axis:
// Turn(axis, angle) * point = centre + cos(angle) along + sin(angle) across.
struct TurnCircle {
  Vector3 centre = Vector3::Zero();
  Vector3 along = Vector3::Zero();
  Vector3 across = Vector3::Zero();

  Vector3 At(double angle) const;
};
TurnCircle CircleOf(const JointAxis& axis, const Vector3& point);

// Returns the distance between two lines, in metres.
double DistanceBetween(const JointAxis& a, const JointAxis& b);

// Returns true if the lines have the same direction or opposite directions, to within 1e-9.
bool AreParallel(const JointAxis& a, const JointAxis& b);

// Returns true if the lines meet in one point, to within kFileTolerance.
bool Meet(const JointAxis& a, const JointAxis& b);
// Returns the point of a that is nearest to b. The lines must not be parallel.
Vector3 NearestPoint(const JointAxis& a, const JointAxis& b);

}  // namespace assay::kinematics
