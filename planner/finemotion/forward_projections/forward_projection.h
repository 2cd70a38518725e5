#pragma once

#include "planner/finemotion/contacts/generalized_point.h"
#include "planner/geometry/zonotopes/zonotope.h"

namespace assay::finemotion {

// All points of generalized space that a part can reach if it starts in `start` and moves for at
// most `time` seconds at one velocity out of `velocity`: { z + s v : z in start, v in velocity, 0
// <= s <= time } (Dakin and Popplestone, section 4 and figure 12). The velocity components of model
// errors are 0, since model errors do not move. The projection is convex, since the set of
// velocities is convex.
struct ForwardProjection {
  geometry::Zonotope start;
  geometry::Zonotope velocity;
  double time = 0;

  double Support(const Eigen::VectorXd& a) const;
  GeneralizedPoint Farthest(const Eigen::VectorXd& a) const;
};

}  // namespace assay::finemotion
