#pragma once

#include <limits>
#include <span>

#include "tests/oracle/random_pose.h"

// How a body comes to rest, from its corners alone and without its facets.
namespace assay::oracle {

// How high the centre of mass is above a table when `down` (unit, body frame) points down.
inline double HeightOfCenter(std::span<const geometry::Vector3> corners,
                             const geometry::Vector3& center, const geometry::Vector3& down) {
  double height = -std::numeric_limits<double>::infinity();
  for (const geometry::Vector3& p : corners) height = std::max(height, down.dot(p - center));
  return height;
}

// The direction that ends up pointing down when the body is let go with `down` pointing down, rolls
// without swing and loses height only: random steps that lower the centre, ever shorter. To within
// a few thousandths of a radian.
inline geometry::Vector3 RollToRest(std::span<const geometry::Vector3> corners,
                                    const geometry::Vector3& center, geometry::Vector3 down,
                                    RandomStream& random) {
  double height = HeightOfCenter(corners, center, down);
  for (double step = 0.1; step > 1e-3;) {
    bool lower = false;
    for (int i = 0; i < 2000 && !lower; ++i) {
      const geometry::Vector3 next = (down + RandomVector(random, step)).normalized();
      const double next_height = HeightOfCenter(corners, center, next);
      lower = next_height < height;
      if (lower) {
        down = next;
        height = next_height;
      }
    }
    if (!lower) step /= 2;
  }
  return down;
}

}  // namespace assay::oracle
