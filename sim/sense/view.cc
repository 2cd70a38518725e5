#include "sim/sense/view.h"

#include <cmath>

#include "planner/base/check.h"
#include "planner/geometry/pose.h"

namespace assay::sense {
namespace {

constexpr double kRoll = 0.3;

Pose LookingAt(const Vector3& eye, const Vector3& target) {
  const Vector3 back = (eye - target).normalized();
  const bool vertical = back.cross(Vector3::UnitZ()).norm() < 1e-6;
  const Vector3 up = vertical ? Vector3::UnitX() : Vector3::UnitZ();
  const Vector3 right = up.cross(back).normalized();
  return geometry::PoseFromColumns(right, back.cross(right), back, eye);
}

}  // namespace

View::View(const Vector3& eye, const Vector3& target, double radius, int size) : size_(size) {
  const double distance = (target - eye).norm();
  ASSAY_CHECK(radius > 0 && distance > radius && size > 0, "a ball of {} m, {} m away", radius,
              distance);
  const double half_angle = std::asin(radius / distance);
  camera_ = {LookingAt(eye, target) * geometry::RotationZ(kRoll), 2 * half_angle};
  focal_length_ = size / 2.0 / std::tan(half_angle);
}

Vector3 View::InCamera(const Vector3& p_World) const {
  return camera_.X_WorldCamera.linear().transpose() *
         (p_World - camera_.X_WorldCamera.translation());
}

Vector2 View::Project(const Vector3& p_World) const {
  const Vector3 p = InCamera(p_World);
  const double scale = focal_length_ / -p.z();
  return {size_ / 2.0 + scale * p.x(), size_ / 2.0 - scale * p.y()};
}

Eigen::Matrix<double, 2, 3> View::ProjectionRate(const Vector3& p_World) const {
  const Vector3 p = InCamera(p_World);
  const double scale = focal_length_ / -p.z();
  Eigen::Matrix<double, 2, 3> in_camera;
  in_camera << scale, 0, scale * p.x() / -p.z(), 0, -scale, -scale * p.y() / -p.z();
  return in_camera * camera_.X_WorldCamera.linear().transpose();
}

}  // namespace assay::sense
