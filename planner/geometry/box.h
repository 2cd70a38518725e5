#pragma once

#include <array>

#include "planner/geometry/coordinates.h"


namespace assay::geometry {

// A rectangular block.
struct Box {
  Pose X_FrameBox = Pose::Identity();      // the origin is the box's centre
  Vector3 half_extents = Vector3::Zero();  // metres, along the box's axes

  static Box FromCorners(const Vector3& low, const Vector3& high);

  std::array<Vector3, 8> Corners() const;
  double Volume() const { return 8 * half_extents.prod(); }
  // Returns true if p is inside the box, or at most `tolerance` outside. A negative tolerance
  // requires p to be at least that deep inside.
  bool Contains(const Vector3& p, double tolerance) const;
  Box Transformed(const Pose& X_NewFrame) const { return {X_NewFrame * X_FrameBox, half_extents}; }
};

}  // namespace assay::geometry
