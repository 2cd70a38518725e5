#pragma once

#include <vector>

#include "planner/finemotion/contacts/polyhedron.h"

namespace assay::finemotion {

// A side of a convex part of a face: outward . p <= height of the points inside.
struct RegionSide {
  Vector3 outward = Vector3::Zero();  // unit, in the face's plane
  double height = 0;                  // metres
  Vector3 start = Vector3::Zero();    // the corners that it joins
  Vector3 end = Vector3::Zero();

  Vector3 middle() const { return (start + end) / 2; }
  double Excess(const Vector3& p) const { return outward.dot(p) - height; }  // positive: outside
};

// A convex part of a face, by its sides.
using FaceRegion = std::vector<RegionSide>;

// The face as few convex regions: two polygons are made one where that is convex, so that a seam
// between pieces of a part limits as few contacts as possible.
std::vector<FaceRegion> ConvexRegions(const OuterFace& face);

// Of a point of the face's plane; 0 inside.
double DistanceTo(const FaceRegion& region, const Vector3& p);

}  // namespace assay::finemotion
