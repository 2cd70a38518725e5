#include "planner/kinematics/arm_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace assay::kinematics {
namespace {

// A joint's axis in the base's frame when all joint values are 0.
struct AxisLine {
  Vector3 point;
  Vector3 direction;
};

bool IsZero(double value) { return std::abs(value) < kFileTolerance; }

bool HasDirections(const std::array<AxisLine, 6>& axes) {
  for (std::size_t i = 0; i < 6; ++i) {
    const bool along_y = i == 1 || i == 2 || i == 4;
    const Vector3 wanted = along_y ? Vector3::UnitY() : Vector3::UnitZ();
    if (!IsZero((axes[i].direction - wanted).norm())) return false;
  }
  return true;
}

bool HasPlaces(const std::array<AxisLine, 6>& axes) {
  const Vector3& roll = axes[3].point;
  return std::ranges::all_of(
      std::array{axes[0].point.x(), axes[0].point.y(), axes[1].point.x(), axes[1].point.z(),
                 axes[2].point.z(), axes[4].point.x() - roll.x(), axes[5].point.x() - roll.x(),
                 axes[5].point.y() - roll.y()},
      IsZero);
}

}  // namespace

std::optional<ArmGeometry> GeometryOf(const RobotModel& arm) {
  std::array<AxisLine, 6> axes;
  Pose X_BaseLink = Pose::Identity();
  for (std::size_t i = 0; i < 6; ++i) {
    X_BaseLink = X_BaseLink * arm.joints[i].X_ParentJoint;
    axes[i] = {X_BaseLink.translation(), X_BaseLink.linear() * arm.joints[i].axis};
  }
  const Vector3& elbow = axes[2].point;
  const Vector3& roll = axes[3].point;
  const Vector3& bend = axes[4].point;
  const Vector3 flange = X_BaseLink.translation();
  const bool is_straight =
      (X_BaseLink.linear() - Matrix3::Identity()).cwiseAbs().maxCoeff() < kFileTolerance &&
      IsZero((flange - Vector3(roll.x(), roll.y(), flange.z())).norm());
  if (!HasDirections(axes) || !HasPlaces(axes) || !is_straight) return std::nullopt;
  const ArmGeometry geometry = {.a2 = elbow.x(),
                                .a3 = roll.x() - elbow.x(),
                                .d2 = roll.y(),
                                .d4 = bend.z(),
                                .d6 = flange.z() - bend.z()};
  if (geometry.a2 < kFileTolerance || geometry.d4 < kFileTolerance) return std::nullopt;
  return geometry;
}

}  // namespace assay::kinematics
