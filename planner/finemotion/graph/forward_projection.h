#pragma once

#include "planner/finemotion/contacts/primitive_contact.h"
#include "planner/geometry/zonotope.h"

namespace assay::finemotion {

// All points of generalized space that a part can reach if it starts in `start` and moves for at
// most `time` seconds at one velocity out of `velocity`: { z + s v : z in start, v in velocity, 0
// <= s <= time } (Dakin and Popplestone, section 4 and figure 12). The velocity components of model
// errors are 0, since these do not move. The projection is convex, since the velocities are.
struct ForwardProjection {
  geometry::Zonotope start;
  geometry::Zonotope velocity;
  double time = 0;

  double Support(const Eigen::VectorXd& a) const;
  GeneralizedPoint Farthest(const Eigen::VectorXd& a) const;
};

// Returns a zonotope that holds every point at which a motion of the projection can meet the
// contact's C-surface (R_1 of the paper, section 4). It is tight in the start, and to first order
// in the errors of the velocity. Every velocity in `velocity` must approach the surface, which is
// checked.
geometry::Zonotope RegionAtContact(const ForwardProjection& projection,
                                   const PrimitiveContact& contact);

}  // namespace assay::finemotion
