#pragma once

#include <span>
#include <vector>

#include "planner/geometry/box.h"

namespace assay::geometry {

// Returns the greatest gap between the projections of two boxes onto any of the 15 axes that can
// separate them, in metres. Between boxes that are apart, it is at most their distance. Between
// boxes that overlap it is negative: the least motion that would part them. (Gottschalk, Lin and
// Manocha 1996.)
double Separation(const Box& a, const Box& b);

// Returns the deepest overlap of any box of `a` with any box of `b`, in metres; 0 if none overlap.
double OverlapDepth(std::span<const Box> a, std::span<const Box> b);

std::vector<Box> Moved(std::span<const Box> boxes, const Pose& X_NewFrame);

// Returns the height of the boxes' lowest corner over the plane z = 0 of their frame.
double LowestPoint(std::span<const Box> boxes);

}  // namespace assay::geometry
