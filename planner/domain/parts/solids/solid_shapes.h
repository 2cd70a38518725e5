#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/input_files/document.h"
#include "planner/domain/units/units.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/solids/round_solid.h"

namespace assay::domain {

// How far sides of a pocket are set back from where the file has them.
struct Widening {
  std::array<bool, 3> along = {};  // the sides of a box along x, y, z
  bool across = false;             // all sides that lie along the axis of a prism, cylinder or cone
  double by = 0;                   // metres; negative sides come nearer
};

// A polygon with many sides stands for a circle. It is around the circle of a solid, and within the
// circle of a pocket: material that a round part does not have is then never missing in the model.
enum class Roundness { kAround, kWithin };

// The shape that a part file gives to a solid or a pocket.
struct SolidShape {
  std::vector<geometry::ConvexHull> pieces;    // convex, in the file's coordinates
  std::vector<geometry::Vector3> moved_sides;  // outward normals of the sides that were widened
  std::optional<geometry::RoundSolid> round;   // what the shape stands for, if it is round
};

// The keys of the kinds of shapes: box, prism, cylinder, cone, hull, mesh.
const std::vector<std::string>& ShapeKinds();
// Reads the shape of an entry that has exactly one of these keys. Throws InputError at the place of
// what is wrong.
SolidShape ReadShape(const Value& entry, const Units& units, Roundness roundness,
                     const Widening& widening);

}  // namespace assay::domain
