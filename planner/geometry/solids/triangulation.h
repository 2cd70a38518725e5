#pragma once

#include <array>
#include <span>
#include <vector>

#include "planner/geometry/coordinates.h"


namespace assay::geometry {

using Loop = std::vector<int>;  // indices of points, in order

// Returns triangles that fill the region inside of counter-clockwise loops and outside of clockwise
// loops, by cutting ears (Meisters 1975). Every edge of a loop is an edge of exactly one triangle,
// even if loops cross or are flat. Then triangles may overlap, but their signed areas add up to the
// region's.
std::vector<std::array<int, 3>> Triangulated(std::span<const Vector2> points,
                                             const std::vector<Loop>& loops);

}  // namespace assay::geometry
