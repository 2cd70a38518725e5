#pragma once

#include <array>
#include <vector>

#include "planner/geometry/pose.h"

namespace assay::finemotion {

using geometry::Pose;
using geometry::Vector3;

inline constexpr double kSameDirection = 1e-6;  // sine of the angle below which directions agree
inline constexpr double kSamePoint = 1e-6;      // metres, below which points do

// A convex piece of a part: its corners, in any order (the hull's corners, no others are needed).
struct ConvexPiece {
  std::vector<Vector3> corners;  // metres, part frame
};

// A face of a part's outside: a plane, and the region of it that is outside, as disjoint convex
// polygons (counter-clockwise seen from outside).
struct OuterFace {
  Vector3 normal = Vector3::Zero();  // unit, outward
  double height = 0;                 // normal . point of the plane, metres
  std::vector<std::vector<Vector3>> region;
};

// A convex edge, or what of it is outside.
struct OuterEdge {
  Vector3 start = Vector3::Zero();
  Vector3 end = Vector3::Zero();
  std::array<int, 2> faces{};  // indices of the faces that it joins

  Vector3 direction() const { return (end - start).normalized(); }
};

// A convex corner: one that can touch a plane without anything else of the part touching it.
struct OuterVertex {
  Vector3 p = Vector3::Zero();
  std::vector<int> edges;  // indices of the edges that leave it
};

// The outside of a union of convex pieces: what another part can touch (Dakin and Popplestone,
// section 2: "primitive contacts"). Seams between pieces that lie in one plane are no edges;
// concave edges and corners, which touch nothing before their neighbours do, are left out.
struct Polyhedron {
  std::vector<OuterFace> faces;
  std::vector<OuterEdge> edges;
  std::vector<OuterVertex> vertices;
};

// Pieces may touch and overlap. Features shorter than `tolerance` (metres) are dropped, points
// nearer than it count as one.
Polyhedron OutsideOf(const std::vector<ConvexPiece>& pieces, double tolerance = 1e-7);

// The same shape in another frame.
Polyhedron Transformed(Polyhedron shape, const Pose& X_NewOld);

}  // namespace assay::finemotion
