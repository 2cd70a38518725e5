#pragma once

#include <limits>

#include "planner/geometry/coordinates.h"


namespace assay::finemotion {

// An axis-aligned box around features. It serves to exclude quickly features that are not near to
// each other.
struct Extent {
  using Vector3 = geometry::Vector3;

  Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity());
  Vector3 high = Vector3::Constant(-std::numeric_limits<double>::infinity());

  static Extent Of(const Vector3& a, const Vector3& b) { return {a.cwiseMin(b), a.cwiseMax(b)}; }

  void Add(const Vector3& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  // Returns whether the boxes are within `reach` (metres) of each other along each axis. If not,
  // the features are surely farther apart.
  bool IsNear(const Extent& other, double reach) const {
    return low.x() - other.high.x() <= reach && other.low.x() - high.x() <= reach &&
           low.y() - other.high.y() <= reach && other.low.y() - high.y() <= reach &&
           low.z() - other.high.z() <= reach && other.low.z() - high.z() <= reach;
  }
  bool IsNear(const Vector3& p, double reach) const { return IsNear(Of(p, p), reach); }
};

}  // namespace assay::finemotion
