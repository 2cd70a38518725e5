#pragma once

#include <vector>

#include "planner/geometry/coordinates.h"

namespace assay::domain {

class PartModel;

// Returns the point at which a part touches a plane in place of one of its corners on the plane.
// All are in the part frame, and `normal` (unit) points from the part into the plane. A round solid
// touches the plane along one line, and not along a side of the polygons that stand for it. Other
// corners are returned as they are.
geometry::Vector3 TrueTouch(const PartModel& part, const geometry::Vector3& corner,
                            const geometry::Vector3& normal);

// Returns the points at which a part touches the table, in the world: its lowest corners, or what
// touches in place of them (TrueTouch). Returns none if it does not touch.
std::vector<geometry::Vector3> CornersOnTable(const PartModel& part,
                                              const geometry::Pose& X_WorldPart);

// Returns the convex areas, by their corners in the world, in which faces of the upper part that
// look down lie on faces of the lower part.
std::vector<std::vector<geometry::Vector3>> AreasOfContact(const PartModel& upper,
                                                           const geometry::Pose& X_WorldUpper,
                                                           const PartModel& lower,
                                                           const geometry::Pose& X_WorldLower);
// Returns the convex patches, by their corners in the world, of all faces of the lower part on
// which faces of the upper part lie. They also have what lies beside the areas of contact.
std::vector<std::vector<geometry::Vector3>> FacesInContact(const PartModel& upper,
                                                           const geometry::Pose& X_WorldUpper,
                                                           const PartModel& lower,
                                                           const geometry::Pose& X_WorldLower);
// Returns the corners of all areas of contact. Returns none if there are no areas.
std::vector<geometry::Vector3> CornersOfContact(const PartModel& upper,
                                                const geometry::Pose& X_WorldUpper,
                                                const PartModel& lower,
                                                const geometry::Pose& X_WorldLower);

}  // namespace assay::domain
