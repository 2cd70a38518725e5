#pragma once

#include <cstddef>
#include <vector>

#include "planner/geometry/contact/contact_solid.h"
#include "planner/geometry/coordinates.h"
#include "planner/geometry/outline.h"

namespace assay::geometry {

// Returns the corners of the area that a facet of `of` has in common with the facets of another
// solid: points of the surface of the other solid, at most `margin` above the facet, in the frame
// of `of`.
std::vector<Vector3> CommonCorners(const ContactSolid& of, int facet, const ContactSolid& other,
                                   const Pose& X_OfOther, double margin);

// Returns at most `most` of the points near a plane: all of them or, if there are more, those that
// are farthest in `most` directions along the plane. The directions depend on the normal alone.
std::vector<Vector3> Outermost(const std::vector<Vector3>& points, const Vector3& normal,
                               std::size_t most);

}  // namespace assay::geometry
