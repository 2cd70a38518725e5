#pragma once

#include <optional>

#include "planner/base/random.h"
#include "planner/domain/problem/problem.h"

namespace assay::domain {

// The same problem with its parts elsewhere: each part that rests on the table by itself keeps its
// stable pose and gets a place and a yaw drawn from the stream, uniform over the table, where it
// lies wholly on the table, leaves the workcell's part gap to all others, and can be taken with
// some grasp. Draws that do not fit are drawn again; nothing after ten thousand of them.
std::optional<Problem> Scatter(const Problem& problem, RandomStream& random);

}  // namespace assay::domain
