#pragma once

#include <cmath>

#include "planner/geometry/coordinates.h"


namespace assay::plan {

// The greatest difference between the pose that the tool is brought to and the planned one. The
// tool may be turned by `spin` about its own z, turned by `turn` about the world's z through its
// origin, and shifted by `shift` along the world's axes.
struct ToolErrorBox {
  geometry::Vector3 shift = geometry::Vector3::Zero();  // metres, >= 0
  double turn = 0;                                      // radians, >= 0
  double spin = 0;                                      // radians, >= 0

  // Returns error bounds that cover both.
  ToolErrorBox Or(const ToolErrorBox& other) const {
    return {shift.cwiseMax(other.shift), std::fmax(turn, other.turn), std::fmax(spin, other.spin)};
  }
};

}  // namespace assay::plan
