#pragma once

#include <array>
#include <span>
#include <vector>

#include "planner/geometry/pose.h"

namespace assay::geometry {

// A rectangular block. Every solid is a union of boxes, for two reasons. Box against box is the
// only collision of the physics engine that is exact and does not jitter (MuJoCo 2.2.2, box-box). A
// regular 2k-gon prism is a union of k boxes without any decomposition error.
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

// Returns `minuend` without `pocket`, as boxes that do not overlap: the ring of boxes around a
// hole. The pocket must be aligned with the minuend's axes up to multiples of 90 degrees (checked
// to 1e-9). It may extend beyond the minuend. Boxes thinner than 1e-9 m are left out. The floor of
// a blind hole is one box and comes first, followed by the walls.
std::vector<Box> Subtract(const Box& minuend, const Box& pocket);

// Mass, centre of mass and inertia of a union of boxes. Overlaps count once. The result is exact if
// all boxes are aligned with each other (up to multiples of 90 degrees). Otherwise it is accurate
// to about 0.1 %.
struct MassProperties {
  double mass = 0;                    // kg
  Vector3 center = Vector3::Zero();   // centre of mass, in the frame of the boxes
  Matrix3 inertia = Matrix3::Zero();  // about the centre, along the axes of the frame, kg m^2
};
MassProperties MassOf(std::span<const Box> boxes, double density);

}  // namespace assay::geometry
