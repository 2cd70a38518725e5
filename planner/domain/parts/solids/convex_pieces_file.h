#pragma once

#include <filesystem>
#include <vector>

#include "planner/geometry/hull.h"

namespace assay::domain {

// Reads the convex pieces of an OBJ file: each object (a line "o NAME" or "g NAME") is the convex
// hull of its vertices (lines "v X Y Z"). Its faces are not needed. Vertices are multiplied by
// `unit`, in metres. Throws InputError with the line of what is wrong.
std::vector<geometry::ConvexHull> ReadConvexPieces(const std::filesystem::path& file, double unit);

}  // namespace assay::domain
