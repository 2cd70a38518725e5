#pragma once

#include <optional>

#include "planner/base/random.h"
#include "planner/domain/problem/problem.h"

namespace assay::domain {

// Returns the same problem with its parts elsewhere. Each part that rests directly on the table
// keeps its stable pose and gets a place and a yaw drawn from the stream, uniformly over the table.
// There it lies wholly on the table, leaves the workcell's part gap to all others, and can be taken
// with some grasp. Draws that do not fit are repeated. Returns nothing after ten thousand of them.
std::optional<Problem> Scatter(const Problem& problem, RandomStream& random);

}  // namespace assay::domain
