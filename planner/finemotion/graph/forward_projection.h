#pragma once

#include "planner/finemotion/contacts/primitive_contact.h"
#include "planner/finemotion/numeric/zonotope.h"

namespace assay::finemotion {

// Where a part can get that starts somewhere in `start` and moves, for `time` seconds at most, at
// one velocity out of `velocity` (in generalized space; model errors do not move: their components
// are 0): { z + s v : z in start, v in velocity, 0 <= s <= time } (Dakin and Popplestone, section 4
// and figure 12). Convex, as the velocities are.
struct ForwardProjection {
  Zonotope start;
  Zonotope velocity;
  double time = 0;

  double Support(const Eigen::VectorXd& a) const;
  GeneralizedPoint Farthest(const Eigen::VectorXd& a) const;
};

// Holds every point at which a motion of the projection can meet the contact's C-surface
// (tight in the start, and in the velocities to first order of their errors): R_1 of the paper,
// section 4. `velocity` must approach the surface, whatever its error (checked).
Zonotope RegionAtContact(const ForwardProjection& projection, const PrimitiveContact& contact);

}  // namespace assay::finemotion
