#pragma once

#include <span>
#include <vector>

#include "planner/geometry/hull.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/solids/round_solid.h"

namespace assay::plan {

// The checker's own geometry of balance. It shares no code with the geometry of the planner.

// Returns, for the checker, the centre of mass of a union of convex solids of one density, with
// overlaps counted once. It sums cells between the coordinates of the vertices. The result is exact
// for boxes that are aligned with the axes of their frame, and accurate to about a hundredth of
// their extent for other solids.
geometry::Vector3 CenterOfMass(std::span<const geometry::ConvexHull> solids);

// Returns the points on which the checker takes a part to stand: those of its corners that are
// within 1 micrometre of the table, the plane z = 0. A corner of a polygon that stands for a circle
// is replaced by the lowest point of the circle if the circle touches the table beside the corner.
// All coordinates are the world's.
std::vector<geometry::Vector3> TouchingTable(std::span<const geometry::Vector3> corners,
                                             std::span<const geometry::RoundSolid> round_solids);

// Returns whether the checker finds a centre of mass p supported: p is strictly inside the convex
// hull of the points' projections onto x and y. That is so if every half plane through p contains
// some point.
bool IsSupported(const geometry::Vector3& p, std::span<const geometry::Vector3> points);

// Returns the first point that the checker finds beside a table: a point that does not project into
// the polygon (convex, counter-clockwise); null if all do.
const geometry::Vector3* FirstOutside(std::span<const geometry::Vector3> points,
                                      const geometry::Polygon& polygon);

}  // namespace assay::plan
