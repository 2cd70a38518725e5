#pragma once

#include <limits>
#include <span>

#include "tests/oracle/random_pose.h"

// Computes the resting pose of a body. It uses only the corners of the body, and not its facets.
namespace assay::oracle {

// Returns the height of the centre of mass above a table when `down` points down. `down` is a unit
// vector in the body's frame.
inline double HeightOfCenter(std::span<const geometry::Vector3> corners,
                             const geometry::Vector3& center, const geometry::Vector3& down) {
  double height = -std::numeric_limits<double>::infinity();
  for (const geometry::Vector3& p : corners) height = std::max(height, down.dot(p - center));
  return height;
}

// Returns the direction that points down after the body was released with `down` pointing down. The
// body rolls without swing and only loses height. Random steps, which become ever shorter, lower
// the centre. The result is right to a few thousandths of a radian.
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
