#pragma once

#include <vector>

#include "planner/geometry/coordinates.h"
#include "sim/mujoco/data.h"

namespace assay::render {

using geometry::Vector3;

// The drawn shapes of a simulation as obstacles for rays. It finds which points an eye can see.
// Some shapes can be displaced together, as a hand moves together with the part that it mates.
class Sight {
 public:
  // All bodies that are connected to one of `moving` are moving shapes. `data` must outlive the
  // Sight.
  explicit Sight(const mujoco::Data& data, const std::vector<mujoco::BodyId>& moving = {});

  // Returns whether no drawn shape is between the point and the eye after the moving shapes have
  // moved by `moved`. All vectors are in the world frame, metres. The first tenth of a millimetre
  // from the point is ignored, so that the surface on which the point lies does not hide it.
  bool Sees(const Vector3& eye, const Vector3& point, const Vector3& moved = Vector3::Zero()) const;

 private:
  struct Shape {
    mujoco::GeomId geom;
    bool moves = false;
  };

  const mujoco::Data& data_;
  std::vector<Shape> shapes_;
};

}  // namespace assay::render
