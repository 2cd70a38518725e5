#pragma once

#include <vector>

#include "planner/domain/part/part_model.h"

namespace assay::scene {

// Few boxes with the same convex hull as the part's: boxes that share their axes are replaced by
// the box around them wherever that is inside the hull, so that rings around holes are filled. A
// part touches the table, a plane, with its hull only; with these it does so in the fewest
// contacts, which is most of what a simulation of parts at rest costs.
std::vector<geometry::Box> SupportingBoxes(const domain::PartModel& part);

}  // namespace assay::scene
