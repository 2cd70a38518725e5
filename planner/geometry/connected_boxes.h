#pragma once

#include <span>

#include "planner/geometry/box.h"

namespace assay::geometry {

// Returns the index of the first box that is not connected with the first box of all, directly or
// by way of others; -1 if there is none. Two boxes are connected if they share a volume, or a face
// at least, since edges and corners hold nothing. Boxes that are less than a micrometre apart count
// as sharing a face. There must be a box, and no side may be shorter than 10 micrometres.
int FirstApart(std::span<const Box> boxes);

}  // namespace assay::geometry
