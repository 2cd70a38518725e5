#pragma once

#include <optional>
#include <span>
#include <vector>

#include "planner/geometry/box.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/outline.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/rounded_hull.h"

namespace assay::geometry {

// Cuts through convex solids. Lengths are in metres. What is thinner than a nanometre counts as
// rounding and is left out.

// Returns the part of a solid below a plane (normal . p <= height), or none if nothing remains.
std::optional<ConvexHull> Below(const ConvexHull& solid, const Plane& plane);

// Returns what two solids have in common, or none.
std::optional<ConvexHull> Intersection(const ConvexHull& a, const ConvexHull& b);

// Returns a solid without a pocket, as convex pieces that do not overlap. The pocket may extend
// beyond the solid. Facets of the pocket are cut along in the order of how much of the solid lies
// beyond them, the greatest first, so that the floor of a blind hole is one piece.
std::vector<ConvexHull> Without(const ConvexHull& solid, const ConvexHull& pocket);

// Returns a union of solids as solids that do not overlap.
std::vector<ConvexHull> Disjoint(std::span<const ConvexHull> solids);

// Returns the solid with each facet moved inward by `depth`, or none if nothing remains.
std::optional<ConvexHull> Inset(const ConvexHull& solid, double depth);

// Returns the exact shadow along z of the part of a solid that lies between the planes z = low and
// z = high (low <= high). Equal planes give the cross-section. If the result has fewer than three
// corners, the solid is not between the planes, or only touches them.
Polygon ShadowBetween(const ConvexHull& solid, double low, double high);

// Returns the mass properties of a union of solids, exactly. Overlaps count once.
MassProperties MassOf(std::span<const ConvexHull> solids, double density);

}  // namespace assay::geometry
