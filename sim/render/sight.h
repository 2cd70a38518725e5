#pragma once

#include <vector>

#include "planner/geometry/pose.h"
#include "sim/mujoco/data.h"

namespace assay::render {

using geometry::Vector3;

// What of a simulation is drawn, for rays: which points of it can be seen from where. Some of it
// moves on together, in one direction, as the hand does with the part that it mates.
class Sight {
 public:
  // All that hangs together with one of these bodies moves. `data` must outlive this.
  explicit Sight(const mujoco::Data& data, const std::vector<mujoco::BodyId>& moving = {});

  // Whether nothing that is drawn is between the point and the eye, when what moves has moved by
  // `moved` (world frame, metres). What is within a tenth of a millimetre of the point, as the
  // surface that it lies on, hides it only if it goes on farther towards the eye.
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
