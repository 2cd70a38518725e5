#pragma once

#include <vector>

#include "planner/geometry/zonotopes/zonotope.h"

namespace assay::geometry {

// Returns all sums of the center and the generators with any signs. These include the corners, and
// points inside.
inline std::vector<Eigen::VectorXd> Corners(const Zonotope& of) {
  std::vector<Eigen::VectorXd> corners = {of.center};
  for (const auto generator : of.generators.colwise()) {
    std::vector<Eigen::VectorXd> both;
    for (const Eigen::VectorXd& corner : corners) {
      both.emplace_back(corner + generator);
      both.emplace_back(corner - generator);
    }
    corners = both;
  }
  return corners;
}

}  // namespace assay::geometry
