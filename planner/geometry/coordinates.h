#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace assay::geometry {

using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

// A rigid transform. X_AB is the pose of frame B in frame A: p_A = X_AB * p_B. Units are metres and
// radians.
using Pose = Eigen::Isometry3d;

// A convex polygon in the plane, with corners in counter-clockwise order.
using Polygon = std::vector<Vector2>;

}  // namespace assay::geometry
