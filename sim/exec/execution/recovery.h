#pragma once

#include <vector>

#include "planner/plan/data/plan.h"

namespace assay::exec {

using geometry::Vector3;

// Where a recovery tries the step again, as offsets from where it was tried at first, metres, in
// the plane across `axis` (unit, world frame): circles that grow by the pitch up to the radius,
// with places a pitch apart, for a groping search; nowhere else, a few times, for a retry; nowhere
// for a call of the operator.
std::vector<Vector3> PlacesToTry(const plan::Recovery& recovery, const Vector3& axis);

inline constexpr int kRetries = 3;

}  // namespace assay::exec
