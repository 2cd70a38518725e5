#pragma once

#include <optional>

#include "planner/domain/parts/part_model.h"
#include "planner/geometry/coordinates.h"

namespace assay::domain {

// Returns how far a held part moves along a direction (unit, in the fixed part's frame) until
// something stops it, in metres, up to a micrometre. The fixed part stops it, or the table on which
// that side of the fixed part lies which looks in the direction. It is negative if the held part is
// farther than the table, or if the parts overlap until the held part moves back. It is 0 if they
// overlap even `farthest` metres back, and none if the way is longer than this.
std::optional<double> WayToSeat(const PartModel& held, const PartModel& fixed,
                                const Pose& X_FixedHeld, const Vector3& direction, double farthest);

}  // namespace assay::domain
