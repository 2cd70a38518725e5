#pragma once

#include <optional>
#include <span>

#include "planner/domain/reachability/reachability.h"
#include "planner/plan/data/plan.h"

namespace assay::motion {

// Returns how the arm can take the part at X_WorldPart so that the part stays as upright as
// possible. Among the grasps that are reachable and leave room between `others` for the open
// fingers, it chooses the grasp that comes most from above. Returns none if there is no such grasp.
std::optional<plan::Hold> MostUprightHold(const domain::Problem& problem, domain::PartId part,
                                          const geometry::Pose& X_WorldPart,
                                          std::span<const domain::PlacedPart> others);

}  // namespace assay::motion
