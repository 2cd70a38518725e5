#pragma once

#include <vector>

#include "planner/finemotion/search/maneuver.h"

namespace assay::workloads {

using finemotion::ConvexPiece;
using finemotion::Polyhedron;
using geometry::Vector3;

// --- Shapes whose features have known indices.

// A convex polyhedron from its corners and its faces' outlines (indices of corners,
// counter-clockwise seen from outside).
Polyhedron FromOutlines(const std::vector<Vector3>& corners,
                        const std::vector<std::vector<int>>& outlines);

// Faces in the order -x, +x, -y, +y, -z, +z; corner i has high x, y, z where its bits 1, 2, 4 are.
Polyhedron BoxShape(const Vector3& low, const Vector3& high);
Polyhedron CubeShape(double half);

// The part of a block near a square hole through it, |x| and |y| < half, -depth < z < 0: its top
// (face 0, out to |x| and |y| = outer), the walls (1 to 4) and the rim's edges (0 to 3) at +x, +y,
// -x, -y. The hole has no convex corner.
Polyhedron SquareHoleShape(double half, double outer, double depth);

// --- Pieces.

// The corners as BoxShape numbers them.
ConvexPiece BoxPiece(const Vector3& low, const Vector3& high);

// A regular prism about z: sides that face along +x and from there on at equal angles.
struct PrismModel {
  int sides = 4;    // even
  double half = 0;  // metres from the axis to a side
  double length = 0;
};
// From z = 0 up.
ConvexPiece PrismPiece(const PrismModel& model);
// What is around such a hole, from z = 0 down, out to `outer` metres from the axis: one piece for
// each side.
std::vector<ConvexPiece> AroundHole(const PrismModel& model, double outer);

// A peg of so many sides over a hole that is wider by `play` metres on each side. The tip is the
// middle of the peg's lower end, at the entry in the middle of the hole's rim.
finemotion::Passage PegInHole(const PrismModel& peg, double play);

}  // namespace assay::workloads
