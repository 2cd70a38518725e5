#pragma once

#include <vector>

#include "planner/domain/parts/part_model.h"

namespace assay::scene {

// Returns a few boxes with the same convex hull as the part. Two boxes with the same axes are
// replaced by the box around them if this box is inside the hull, which fills rings around holes. A
// part touches a plane table only with its hull, so these boxes give the same support with few
// contacts. Contacts cause most of the cost of simulating parts at rest.
std::vector<geometry::Box> SupportingBoxes(const domain::PartModel& part);

}  // namespace assay::scene
