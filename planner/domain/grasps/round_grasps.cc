#include "planner/domain/grasps/round_grasps.h"

#include <algorithm>
#include <cmath>

#include "planner/domain/grasps/pad_region.h"

namespace assay::domain {

bool RoundGrasps::Add(const RoundSide& side, const Vector3& closing) {
  const Vector3 axis = side.X_PartAxis.linear().col(2);
  const auto is_alike = [&](const Taken& other) {
    const Vector3 apart = other.side.X_PartAxis.translation() - side.X_PartAxis.translation();
    return axis.cross(other.side.X_PartAxis.linear().col(2)).norm() < kEqualLength &&
           axis.cross(apart).norm() < kEqualLength &&
           std::abs(side.radius - other.side.radius) < kEqualLength &&
           std::abs(closing.dot(other.closing)) > std::cos(step_ - kRounding);
  };
  if (std::ranges::any_of(taken_, is_alike)) return false;
  taken_.push_back({side, closing});
  return true;
}

}  // namespace assay::domain
