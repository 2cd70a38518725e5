#include "planner/geometry/box.h"

#include "planner/base/check.h"
#include "planner/geometry/pose.h"

namespace assay::geometry {

Box Box::FromCorners(const Vector3& low, const Vector3& high) {
  ASSAY_CHECK((low.array() <= high.array()).all());
  return {Translation((low + high) / 2), (high - low) / 2};
}

std::array<Vector3, 8> Box::Corners() const {
  std::array<Vector3, 8> corners;
  for (int i = 0; i < 8; ++i) {
    const Vector3 signs((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
    corners[i] = X_FrameBox * signs.cwiseProduct(half_extents);
  }
  return corners;
}

}  // namespace assay::geometry
