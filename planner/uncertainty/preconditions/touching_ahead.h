#pragma once

#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/geometry/hull.h"

namespace assay::uncertainty {

// Returns whether a piece of the fixed part lies ahead of a piece of the held part even at the seat
// of a straight mating. The first contact of such pieces is the seat, or comes before it only
// because the held part leans. Each piece is in the frame of its part.
bool LiesAhead(const domain::Mating& mating, const geometry::ConvexHull& of_fixed,
               const geometry::ConvexHull& of_held);

// Returns points, in the frame of the fixed part, whose hull has all places at which the held part
// may touch the fixed part before it touches the seat. A part that leans may touch pieces that lie
// lower than the seat first. The held part leans by up to `lean` radians against the fixed part,
// and is displaced across the motion by up to `off` metres.
std::vector<geometry::Vector3> FirstTouches(const domain::Problem& problem,
                                            const domain::Mating& mating, double lean, double off);

}  // namespace assay::uncertainty
