#pragma once

#include <span>
#include <vector>

#include "planner/geometry/polygon.h"
#include "planner/plan/check/box_overlap.h"

namespace assay::plan {

// The centre of mass of a union of boxes of one density, overlaps counted once, by summing cells
// between all coordinates of corners: exact if the boxes are aligned with the axes of their frame,
// else to about a hundredth of their extent.
geometry::Vector3 CenterOfMass(std::span<const Box> boxes);

std::vector<geometry::Vector3> CornersOf(std::span<const Box> boxes);

// The points within 1 micrometre of the plane z = 0.
std::vector<geometry::Vector3> TouchingTable(std::span<const geometry::Vector3> points);

// Whether p is strictly inside the convex hull of the points' projections onto x and y: seen from
// p, they leave no half plane empty.
bool IsSupported(const geometry::Vector3& p, std::span<const geometry::Vector3> points);

// The first point that does not project into the polygon (convex, counter-clockwise); null if all
// do.
const geometry::Vector3* FirstOutside(std::span<const geometry::Vector3> points,
                                      const geometry::Polygon& polygon);

}  // namespace assay::plan
