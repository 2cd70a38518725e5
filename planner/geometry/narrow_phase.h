#pragma once

#include <memory>
#include <optional>

#include "planner/geometry/coordinates.h"
#include "planner/geometry/hull.h"

namespace assay::geometry {

// FCL's overlap and distance tests for two convex bodies. FCL's templates are instantiated here for
// boxes and hulls only. FCL's own library has them for all shapes, trees and meshes, and looking up
// its 29,000 symbols at the start of the program would take longer than making most plans.

// A box about the origin of its own frame.
struct PlacedBox {
  Vector3 sides;  // full edge lengths
  const Pose& X_ABox;
};
// Returns true if the boxes overlap, by the separating axis test (Gottschalk, Lin and Manocha
// 1996).
bool AreOverlapping(const PlacedBox& a, const PlacedBox& b);
// Returns the distance of the boxes. It is negative if they overlap.
double Distance(const PlacedBox& a, const PlacedBox& b);

// A hull in FCL's representation.
struct GjkHull;
std::shared_ptr<const GjkHull> MakeGjkHull(const ConvexHull& hull);
// The points of two hulls that are nearest to each other, in A's frame.
struct NearestPair {
  Vector3 on_a;
  Vector3 on_b;
};
// Returns none if the hulls overlap.
std::optional<NearestPair> NearestPoints(const GjkHull& a, const GjkHull& b, const Pose& X_AB);
// Returns the vector from A's nearest point to B's nearest point, in A's frame. It is zero if they
// overlap.
Vector3 NearestDifference(const GjkHull& a, const GjkHull& b, const Pose& X_AB);

}  // namespace assay::geometry
