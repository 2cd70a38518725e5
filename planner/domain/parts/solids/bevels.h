#pragma once

#include <span>
#include <vector>

#include "planner/geometry/hull.h"
#include "planner/geometry/outline.h"

namespace assay::domain {

// Bevelled edges, as the `chamfer` of a feature describes them (models/parts/README.md). A bevel
// extends `size` metres along the axis of the feature and as far across it. `axis` is a unit vector
// in the part frame. A height is a distance along it.

// Returns the planes of the bevels around an end of a convex solid. The end is the flat side of the
// solid at the height `end`. There is a plane for each side of the solid that lies along the axis
// and meets this end, unless one of the part's other solids covers the whole edge. There is none
// if the solid does not reach this height.
std::vector<geometry::Plane> BevelsAtEnd(const geometry::ConvexHull& solid,
                                         std::span<const geometry::ConvexHull> solids,
                                         const geometry::Vector3& axis, double end, double size);

// Returns the space that bevels around the mouth of a pocket take from the solids around it, with
// the mouth itself. The mouth is at the height `mouth`.
std::vector<geometry::ConvexHull> BevelledMouth(std::span<const geometry::ConvexHull> pocket,
                                                const geometry::Vector3& axis, double mouth,
                                                double size);

}  // namespace assay::domain
