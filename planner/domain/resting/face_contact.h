#pragma once

#include <vector>

#include "planner/geometry/pose.h"

namespace assay::domain {

class PartModel;

// Returns the lowest vertices of a part that touches the table, in the world. Returns none if it
// does not touch.
std::vector<geometry::Vector3> CornersOnTable(const PartModel& part,
                                              const geometry::Pose& X_WorldPart);

// Returns the corners, in the world, of the regions in which faces of the upper part that look down
// lie on faces of the lower part. Returns none if there are no such regions.
std::vector<geometry::Vector3> CornersOfContact(const PartModel& upper,
                                                const geometry::Pose& X_WorldUpper,
                                                const PartModel& lower,
                                                const geometry::Pose& X_WorldLower);

}  // namespace assay::domain
