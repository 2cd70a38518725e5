#pragma once

#include <vector>

#include "planner/geometry/coordinates.h"


namespace assay::domain {

class PartModel;

// Returns the lowest vertices of a part that touches the table, in the world. Returns none if it
// does not touch.
std::vector<geometry::Vector3> CornersOnTable(const PartModel& part,
                                              const geometry::Pose& X_WorldPart);

// Returns the convex areas, by their corners in the world, in which faces of the upper part that
// look down lie on faces of the lower part.
std::vector<std::vector<geometry::Vector3>> AreasOfContact(const PartModel& upper,
                                                           const geometry::Pose& X_WorldUpper,
                                                           const PartModel& lower,
                                                           const geometry::Pose& X_WorldLower);
// Returns the corners of all these areas. Returns none if there are no areas.
std::vector<geometry::Vector3> CornersOfContact(const PartModel& upper,
                                                const geometry::Pose& X_WorldUpper,
                                                const PartModel& lower,
                                                const geometry::Pose& X_WorldLower);

}  // namespace assay::domain
