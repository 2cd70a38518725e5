#pragma once

#include <span>
#include <vector>

#include "planner/geometry/box.h"

namespace assay::plan {

using geometry::Box;

// The greatest gap between the projections of two boxes onto any of the 15 axes that can separate
// them, metres; negative: the least motion that would part them, as an overlap. Between boxes that
// are apart the gap is at most their distance. (Gottschalk, Lin and Manocha 1996.)
double Separation(const Box& a, const Box& b);

// The deepest overlap of any box of `a` with any box of `b`, metres; 0 if none overlap.
double OverlapDepth(std::span<const Box> a, std::span<const Box> b);

std::vector<Box> Moved(std::span<const Box> boxes, const geometry::Pose& X_NewFrame);

// The height of the lowest corner over the plane z = 0 of the boxes' frame.
double LowestPoint(std::span<const Box> boxes);

}  // namespace assay::plan
