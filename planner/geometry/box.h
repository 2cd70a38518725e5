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
  Box Transformed(const Pose& X_NewFrame) const { return {X_NewFrame * X_FrameBox, half_extents}; }
};

}  // namespace assay::geometry
