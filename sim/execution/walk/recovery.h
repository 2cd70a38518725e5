#pragma once

#include <vector>

#include "planner/plan/data/plan.h"

namespace assay::execution {

using geometry::Vector3;

// Returns the places where a recovery tries the step again, as offsets from the first place in
// metres (world frame). A groping search tries circles in the plane across `axis` (unit). Their
// radii grow by the pitch up to the recovery's radius, and their places are a pitch apart. A retry
// tries the first place kRetries times. A call of the operator tries none.
std::vector<Vector3> PlacesToTry(const plan::Recovery& recovery, const Vector3& axis);

inline constexpr int kRetries = 3;

}  // namespace assay::execution
