#pragma once

#include "planner/geometry/pose.h"
#include "sim/render/renderer.h"

namespace assay::sense {

using geometry::Pose;
using geometry::Vector2;
using geometry::Vector3;

// How an eye maps the world to its square picture: a pinhole without distortion. Pixel coordinates
// begin at the picture's upper left corner, x to the right, y down; the first pixel's centre is
// (0.5, 0.5).
class View {
 public:
  // An eye at `eye` (world) that turns and zooms until a ball of this radius (metres) about
  // `target` fills the picture of `size` by `size` pixels. The ball must not hold the eye
  // (checked). The picture is rolled, so that upright edges do not run along the columns of pixels,
  // where all samples of an edge would be wrong by the same fraction of a pixel.
  View(const Vector3& eye, const Vector3& target, double radius, int size);

  const render::FreeCamera& camera() const { return camera_; }
  int size() const { return size_; }

  // Of a point in front of the eye, pixels.
  Vector2 Project(const Vector3& p_World) const;
  // How the projection moves with the point, pixels per metre.
  Eigen::Matrix<double, 2, 3> ProjectionRate(const Vector3& p_World) const;

 private:
  Vector3 InCamera(const Vector3& p_World) const;

  render::FreeCamera camera_;
  int size_;
  double focal_length_;  // pixels
};

}  // namespace assay::sense
