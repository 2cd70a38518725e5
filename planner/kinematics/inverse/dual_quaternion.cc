#include "planner/kinematics/inverse/dual_quaternion.h"

namespace assay::kinematics {
namespace {

using Coefficients = Eigen::Vector4d;  // w, x, y, z

Coefficients Hamilton(const Coefficients& a, const Coefficients& b) {
  Coefficients c;
  c[0] = a[0] * b[0] - a.tail<3>().dot(b.tail<3>());
  c.tail<3>() =
      a[0] * b.tail<3>() + b[0] * a.tail<3>() + Vector3(a.tail<3>()).cross(Vector3(b.tail<3>()));
  return c;
}

}  // namespace

DualQuaternion LineOf(const JointAxis& axis) {
  DualQuaternion line;
  line << 0, axis.direction, 0, axis.point.cross(axis.direction);
  return line;
}

DualQuaternion DualQuaternionOf(const Pose& motion) {
  const Eigen::Quaterniond r(motion.linear());
  const Coefficients real(r.w(), r.x(), r.y(), r.z());
  Coefficients half;
  half << 0, motion.translation() / 2;
  DualQuaternion result;
  result << real, Hamilton(half, real);
  return result;
}

DualQuaternion Product(const DualQuaternion& a, const DualQuaternion& b) {
  DualQuaternion c;
  c << Hamilton(a.head<4>(), b.head<4>()),
      Hamilton(a.head<4>(), b.tail<4>()) + Hamilton(a.tail<4>(), b.head<4>());
  return c;
}

}  // namespace assay::kinematics
