#pragma once

#include <string>

#include "planner/geometry/hull.h"

namespace assay::scene {

// Returns the lines of an OBJ file for a convex piece, as an object of this name. Vertices are
// counted from `first` in the whole file; the first vertex of a file is 1. Faces are
// counter-clockwise, seen from outside.
std::string PieceToObj(const std::string& name, const geometry::ConvexHull& piece, int first = 1);

}  // namespace assay::scene
