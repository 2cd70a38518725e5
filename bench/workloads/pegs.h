#pragma once

#include <vector>

#include "planner/finemotion/strategy_search/maneuver.h"

namespace assay::workloads {

using finemotion::ConvexPiece;
using finemotion::Polyhedron;
using geometry::Vector3;

// --- Shapes whose features have known indices.

// Returns a convex polyhedron from its corners and the outlines of its faces. An outline lists
// indices of corners, counter-clockwise as seen from outside.
Polyhedron FromOutlines(const std::vector<Vector3>& corners,
                        const std::vector<std::vector<int>>& outlines);

// Returns a box with its faces in the order -x, +x, -y, +y, -z, +z. The bits 1, 2 and 4 of a
// corner's index are set where its x, y and z are high.
Polyhedron BoxShape(const Vector3& low, const Vector3& high);
Polyhedron CubeShape(double half);

// Returns the part of a block around a square hole with |x| and |y| < half and -depth < z < 0. Its
// features are the top (face 0, out to |x| and |y| = outer), the walls (1 to 4) and the rim's edges
// (0 to 3) at +x, +y, -x, -y. The hole has no convex corner.
Polyhedron SquareHoleShape(double half, double outer, double depth);

// --- Pieces.

// Returns a box with its corners in the order of BoxShape.
ConvexPiece BoxPiece(const Vector3& low, const Vector3& high);

// A regular prism about z. One side faces along +x. The other sides follow at equal angles.
struct PrismModel {
  int sides = 4;    // must be even
  double half = 0;  // metres from the axis to a side
  double length = 0;
};
// Returns the prism from z = 0 upward.
ConvexPiece PrismPiece(const PrismModel& model);
// Returns the surroundings of a hole with this shape, from z = 0 downward and out to `outer` metres
// from the axis: one piece for each side.
std::vector<ConvexPiece> AroundHole(const PrismModel& model, double outer);

// Returns a peg over a hole that is wider by `play` metres on each side. The tip is the middle of
// the peg's lower end, and the entry is the middle of the hole's rim.
finemotion::Passage PegInHole(const PrismModel& peg, double play);

}  // namespace assay::workloads
