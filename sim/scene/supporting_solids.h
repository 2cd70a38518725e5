#pragma once

#include <span>
#include <vector>

#include "planner/geometry/hull.h"

namespace assay::scene {

// Returns a few convex solids with the same convex hull as a part of these pieces. A part touches a
// plane table only with its hull, so these solids give the same support with few contacts. Contacts
// cause most of the cost of simulating parts at rest. The solids for a part that consists of boxes
// are boxes again: two boxes with the same axes are replaced by the box around them if this box is
// inside the hull, which fills rings around holes. Any other part has its hull.
std::vector<geometry::ConvexHull> SupportingSolids(std::span<const geometry::ConvexHull> pieces,
                                                   const geometry::ConvexHull& hull);

}  // namespace assay::scene
