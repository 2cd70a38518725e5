#include "sim/sense/displacement.h"

#include <cmath>

#include "planner/geometry/pose.h"

namespace assay::sense {

geometry::Pose Displaced(const geometry::Pose& X_WorldPart, const Displacement& by) {
  geometry::Pose moved = geometry::RotationZ(by[3]) * X_WorldPart;
  moved.translation() = X_WorldPart.translation() + by.head<3>();
  return moved;
}

Displacement Between(const geometry::Pose& from, const geometry::Pose& to) {
  const geometry::Matrix3 turn = to.linear() * from.linear().transpose();
  Displacement by;
  by << to.translation() - from.translation(),
      std::atan2(turn(1, 0) - turn(0, 1), turn(0, 0) + turn(1, 1));
  return by;
}

}  // namespace assay::sense
