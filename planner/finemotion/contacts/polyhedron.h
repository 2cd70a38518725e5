#pragma once

#include <array>
#include <vector>

#include "planner/geometry/coordinates.h"

namespace assay::finemotion {

using geometry::Pose;
using geometry::Vector3;

// Two directions agree if the sine of their angle is less than this.
inline constexpr double kSameDirection = 1e-6;
// Two points agree if their distance in metres is less than this.
inline constexpr double kSamePoint = 1e-6;

// A convex piece of a part, given by its corners in any order. Points that are not corners of the
// hull are not needed.
struct ConvexPiece {
  std::vector<Vector3> corners;  // metres, part frame
};

// A face of a part's outside: its plane, and the region of the plane that is outside. The region is
// given as disjoint convex polygons, counter-clockwise as seen from outside.
struct OuterFace {
  Vector3 normal = Vector3::Zero();  // unit vector, outward
  double height = 0;                 // normal . p for each point p of the plane, metres
  std::vector<std::vector<Vector3>> region;
  bool is_round = false;  // a side of a shaft or hole of Polyhedron
};

// A convex edge, or the stretch of one that is outside.
struct OuterEdge {
  Vector3 start = Vector3::Zero();
  Vector3 end = Vector3::Zero();
  std::array<int, 2> faces{};  // indices of the two faces that meet at the edge
  bool is_round = false;       // an edge of a side of a shaft or hole of Polyhedron

  Vector3 direction() const { return (end - start).normalized(); }
};

// A convex corner. It can touch a plane while nothing else of the part does.
struct OuterVertex {
  Vector3 p = Vector3::Zero();
  std::vector<int> edges;  // indices of the edges that leave the corner
  bool is_round = false;   // a corner of a side of a shaft or hole of Polyhedron
};

// A round shaft: a cylinder with a free end, its tip.
struct RoundShaft {
  Vector3 tip = Vector3::Zero();   // centre of the rim at the tip
  Vector3 axis = Vector3::Zero();  // unit vector, outward at the tip
  double radius = 0;               // metres
  double length = 0;               // metres from the tip to the end of the cylinder
};

// A round hole: a cylinder that opens into a plane at its mouth.
struct RoundHole {
  Vector3 mouth = Vector3::Zero();  // centre of the rim at the mouth
  Vector3 axis = Vector3::Zero();   // unit vector, outward at the mouth
  double radius = 0;                // metres
  double depth = 0;                 // metres from the mouth to the end of the cylinder
};

// The outside of a union of convex pieces, which is what another part can touch (Dakin and
// Popplestone, section 2: "primitive contacts"). Seams between pieces that lie in one plane are no
// edges. Concave edges and corners are left out, since they touch nothing before their neighbours
// do.
struct Polyhedron {
  std::vector<OuterFace> faces;
  std::vector<OuterEdge> edges;
  std::vector<OuterVertex> vertices;
  // Cylinders that stand for polygons with many sides. Features marked `is_round` belong to these
  // polygons. They bound the shape, but make no contacts of their own: the cylinders make the
  // contacts.
  std::vector<RoundShaft> shafts = {};
  std::vector<RoundHole> holes = {};
};

// Returns the outside of the union of the pieces, which may touch and overlap. Features shorter
// than 1e-7 metres are dropped, and points nearer to each other than that count as one.
Polyhedron OutsideOf(const std::vector<ConvexPiece>& pieces);

// Returns the same shape in another frame.
Polyhedron Transformed(Polyhedron shape, const Pose& X_NewOld);

}  // namespace assay::finemotion
