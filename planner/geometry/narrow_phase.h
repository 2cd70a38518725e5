#pragma once

#include <memory>

#include "planner/geometry/hull.h"
#include "planner/geometry/pose.h"

namespace assay::geometry {

// What FCL's templates tell of two convex bodies. They are instantiated here for the shapes that we
// have (boxes and hulls): FCL's own library has them for all shapes, trees and meshes, and looking
// up its 30,000 symbols would take longer than most plans.

// A box about the origin of its own frame.
struct PlacedBox {
  Vector3 sides;  // full
  const Pose& X_ABox;
};
// By the separating axis test (Gottschalk, Lin and Manocha 1996).
bool AreOverlapping(const PlacedBox& a, const PlacedBox& b);
// Negative if they overlap.
double Distance(const PlacedBox& a, const PlacedBox& b);

// A hull in FCL's terms.
struct GjkHull;
std::shared_ptr<const GjkHull> MakeGjkHull(const ConvexHull& hull);
// From A's nearest point to B's, in A's frame; zero if they overlap.
Vector3 NearestDifference(const GjkHull& a, const GjkHull& b, const Pose& X_AB);

}  // namespace assay::geometry
