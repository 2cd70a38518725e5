#pragma once

#include "planner/geometry/coordinates.h"
#include "sim/render/renderer.h"

namespace assay::sense {

using geometry::Pose;
using geometry::Vector2;
using geometry::Vector3;

// The projection of the world to the square picture of an eye, which is a pinhole without
// distortion. Pixel coordinates begin at the picture's upper left corner, with x to the right and y
// down. The centre of the first pixel is (0.5, 0.5).
class View {
 public:
  // Makes the view of an eye at `eye` (metres, world frame) that turns and zooms until a ball about
  // `target` fills the picture of `size` by `size` pixels. `radius` is the radius of the ball,
  // metres. The ball must not contain the eye (checked). The picture is rolled so that upright
  // edges do not run along the columns of pixels, where all samples of an edge would have the same
  // error.
  View(const Vector3& eye, const Vector3& target, double radius, int size);

  const render::FreeCamera& camera() const { return camera_; }
  int size() const { return size_; }

  // Returns the picture of a point in front of the eye, pixels.
  Vector2 Project(const Vector3& p_World) const;
  // Returns the derivative of the projection by the point, pixels per metre.
  Eigen::Matrix<double, 2, 3> ProjectionRate(const Vector3& p_World) const;

 private:
  Vector3 InCamera(const Vector3& p_World) const;

  render::FreeCamera camera_;
  int size_;
  double focal_length_;  // pixels
};

}  // namespace assay::sense
