#pragma once

#include <span>
#include <vector>

#include "planner/domain/parts/part_model.h"
#include "planner/geometry/hull.h"

namespace assay::scene {

// Returns a few boxes with the same convex hull as the part. Two boxes with the same axes are
// replaced by the box around them if this box is inside the hull, which fills rings around holes. A
// part touches a plane table only with its hull, so these boxes give the same support with few
// contacts. Contacts cause most of the cost of simulating parts at rest.
std::vector<geometry::Box> SupportingBoxes(const domain::PartModel& part);

// Returns a few convex pieces with the same convex hull as a part of these pieces: boxes, as above,
// if all pieces are boxes, and otherwise the hull itself.
std::vector<geometry::ConvexHull> SupportingPieces(std::span<const geometry::ConvexHull> pieces,
                                                   const geometry::ConvexHull& hull);

}  // namespace assay::scene
