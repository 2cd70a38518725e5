#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "planner/geometry/contact/contact_solid.h"
#include "planner/geometry/coordinates.h"
#include "planner/geometry/outline.h"

namespace assay::geometry {

// The contact of two solids: points with one common normal.
struct ContactManifold {
  struct Point {
    Vector3 at;             // midway between the two surfaces
    double separation = 0;  // along the normal, metres; negative if the solids overlap
  };
  Vector3 normal = Vector3::UnitZ();  // unit, from the first solid to the second
  std::vector<Point> points;
};

// The greatest number of points of a manifold. If there are more points, those are kept that are
// farthest in certain directions, one for each kept point. The directions are fixed to one of the
// solids. Points therefore do not change while the solids rest on each other.
inline constexpr std::size_t kMostContactPoints = 8;

// Returns the contact of two solids that are at most `margin` apart, or none. The manifold is in
// the frame in which the poses are. Its normal is the axis of least overlap (separating_axis.h).
// Where a facet touches, the points are the corners of the area that it has in common with the
// facets of the other solid, as far as the solids are at most `margin` apart there. Where edges
// cross, there is one point.
//
// Edges are considered only if the solids overlap by more than a micrometre along every normal of a
// facet. Edges count only if the overlap along their axis is less by a micrometre than the overlap
// along every such normal. Otherwise the contact is that of a facet, because parts lie still on an
// area of contact, but not on a single point. Rounding therefore does not choose between a facet
// and its edges.
std::optional<ContactManifold> ContactBetween(const ContactSolid& a, const Pose& X_WorldA,
                                              const ContactSolid& b, const Pose& X_WorldB,
                                              double margin);

// Returns the contact of the half-space below a plane with a solid that is at most `margin` apart,
// or none. The points are vertices of the solid. The plane is in the frame of the pose.
std::optional<ContactManifold> ContactBetween(const Plane& plane, const ContactSolid& solid,
                                              const Pose& X_WorldSolid, double margin);

}  // namespace assay::geometry
