#pragma once

#include <array>
#include <span>
#include <vector>

#include "planner/geometry/coordinates.h"


namespace assay::mesh_import {

using Loop = std::vector<int>;  // indices of points, in order

// Returns the area that a loop encloses, negative if it runs clockwise.
double SignedArea(std::span<const geometry::Vector2> points, const Loop& loop);

// Returns whether a point is inside of a loop, by the parity of the edges to its right.
bool IsInside(std::span<const geometry::Vector2> points, const Loop& loop,
              const geometry::Vector2& p);

// Returns triangles that fill the region inside of counter-clockwise loops and outside of clockwise
// loops, by cutting ears (Meisters 1975). Every edge of a loop is an edge of exactly one triangle,
// even if loops cross or are flat. Then triangles may overlap, but their signed areas add up to the
// region's.
std::vector<std::array<int, 3>> Triangulated(std::span<const geometry::Vector2> points,
                                             const std::vector<Loop>& loops);

}  // namespace assay::mesh_import
