#pragma once

#include <vector>

#include "planner/finemotion/contacts/polyhedron.h"

namespace assay::finemotion {

// A side of a convex region of a face. A point p inside the region has outward . p <= height.
struct RegionSide {
  Vector3 outward = Vector3::Zero();  // unit vector in the face's plane
  double height = 0;                  // metres, the greatest outward . p inside the region
  Vector3 start = Vector3::Zero();    // the corners that the side joins
  Vector3 end = Vector3::Zero();

  Vector3 middle() const { return (start + end) / 2; }
  // Positive outside the region.
  double Excess(const Vector3& p) const { return outward.dot(p) - height; }
};

// A convex region of a face, given by its sides.
using FaceRegion = std::vector<RegionSide>;

// Splits a face into convex regions. Two polygons become one region where their union is convex, so
// that a seam between pieces of a part limits as few contacts as possible.
std::vector<FaceRegion> ConvexRegions(const OuterFace& face);

// Returns the distance in metres of a point of the face's plane from the region. It is 0 inside.
double DistanceTo(const FaceRegion& region, const Vector3& p);

}  // namespace assay::finemotion
