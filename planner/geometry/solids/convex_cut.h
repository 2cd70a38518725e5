#pragma once

#include <optional>
#include <span>
#include <vector>

#include "planner/geometry/hull.h"
#include "planner/geometry/outline.h"

namespace assay::geometry {

// Cuts through convex solids. Lengths are in metres. What is thinner than a nanometre counts as
// rounding and is left out.

// Returns the part of a solid below a plane (normal . p <= height), or none if nothing remains.
std::optional<ConvexHull> Below(const ConvexHull& solid, const Plane& plane);

// Returns what two solids have in common, or none.
std::optional<ConvexHull> Intersection(const ConvexHull& a, const ConvexHull& b);

// Returns a solid without a pocket, as convex pieces that do not overlap. The pocket may extend
// beyond the solid. The pocket is cut along pairs of its opposite sides. Pairs between which the
// pocket is open at one end come before pairs with material at both ends. The floor of a blind hole
// is therefore a single piece and comes first, and the walls follow.
std::vector<ConvexHull> Without(const ConvexHull& solid, const ConvexHull& pocket);

// Returns a union of solids as solids that do not overlap.
std::vector<ConvexHull> Disjoint(std::span<const ConvexHull> solids);

// Returns the solid with each facet moved inward by `depth`, or none if nothing remains.
std::optional<ConvexHull> Inset(const ConvexHull& solid, double depth);

}  // namespace assay::geometry
