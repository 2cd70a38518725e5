#pragma once

#include <vector>

#include "planner/geometry/pose.h"

namespace assay::domain {

class PartModel;

// The lowest vertices of a part that touches the table, world; none if it does not.
std::vector<geometry::Vector3> CornersOnTable(const PartModel& part,
                                              const geometry::Pose& X_WorldPart);

// Corners of the regions in which faces of the upper part that look down lie on faces of the lower
// part, world; none if the two do not touch so.
std::vector<geometry::Vector3> CornersOfContact(const PartModel& upper,
                                                const geometry::Pose& X_WorldUpper,
                                                const PartModel& lower,
                                                const geometry::Pose& X_WorldLower);

}  // namespace assay::domain
