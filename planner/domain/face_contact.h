#pragma once

#include <vector>

#include "planner/geometry/pose.h"

namespace assay::domain {

class PartModel;

inline constexpr double kTouching = 1e-5;  // metres between what touches

// Corners of the regions in which faces of the upper part that look down lie on faces of the lower
// part, world; none if the two do not touch so.
std::vector<geometry::Vector3> CornersOfContact(const PartModel& upper,
                                                const geometry::Pose& X_WorldUpper,
                                                const PartModel& lower,
                                                const geometry::Pose& X_WorldLower);

}  // namespace assay::domain
