#include "planner/kinematics/inverse/joint_axis.h"

#include <cmath>

#include "planner/kinematics/urdf_model.h"

namespace assay::kinematics {

Pose Turn(const JointAxis& axis, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const Vector3& h = axis.direction;
  const Vector3 v = (1 - c) * h;
  Pose motion;
  motion.linear() << v.x() * h.x() + c, v.x() * h.y() - s * h.z(), v.x() * h.z() + s * h.y(),
      v.y() * h.x() + s * h.z(), v.y() * h.y() + c, v.y() * h.z() - s * h.x(),
      v.z() * h.x() - s * h.y(), v.z() * h.y() + s * h.x(), v.z() * h.z() + c;
  motion.translation() = axis.point - motion.linear() * axis.point;
  motion.makeAffine();
  return motion;
}

JointAxis Moved(const Pose& motion, const JointAxis& axis) {
  return {motion.linear() * axis.direction, motion * axis.point};
}

Vector3 TurnCircle::At(double angle) const {
  return centre + std::cos(angle) * along + std::sin(angle) * across;
}

TurnCircle CircleOf(const JointAxis& axis, const Vector3& point) {
  const Vector3 arm = point - axis.point;
  const Vector3 height = axis.direction * axis.direction.dot(arm);
  return {axis.point + height, arm - height, axis.direction.cross(arm)};
}

double DistanceBetween(const JointAxis& a, const JointAxis& b) {
  const Vector3 normal = a.direction.cross(b.direction);
  const Vector3 between = b.point - a.point;
  if (AreParallel(a, b)) return a.direction.cross(between).norm();
  return std::abs(normal.dot(between)) / normal.norm();
}

bool AreParallel(const JointAxis& a, const JointAxis& b) {
  return a.direction.cross(b.direction).norm() < kFileTolerance;
}

bool Meet(const JointAxis& a, const JointAxis& b) {
  return DistanceBetween(a, b) < kFileTolerance && !AreParallel(a, b);
}

Vector3 NearestPoint(const JointAxis& a, const JointAxis& b) {
  const Vector3 normal = a.direction.cross(b.direction);
  const double along = (b.point - a.point).cross(b.direction).dot(normal) / normal.squaredNorm();
  return a.point + along * a.direction;
}

}  // namespace assay::kinematics
