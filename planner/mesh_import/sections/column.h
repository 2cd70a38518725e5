#pragma once

#include <optional>

#include "planner/mesh_import/sections/contour.h"

namespace assay::mesh_import {

// A piece of a solid or of a hole along the axis of extrusion, which is z here. A straight column
// has the same contour everywhere. A tapered one changes evenly from one contour to another one;
// both are circles, or neither is.
struct Column {
  bool is_hole = false;
  double low = 0;  // z, metres
  double high = 0;
  Contour at_low = {};
  Contour at_high = {};
  bool is_straight = true;
  bool is_step = false;  // whether it stands for sections that are not equal; straight, then
  double beyond = 0;     // by how much material of a step's sections reaches beyond it, metres
  std::optional<Vector2> mouth = {};  // of a notch in a side: the outward normal of the side

  const Contour& At(bool top) const { return top ? at_high : at_low; }
};

struct ColumnRules {
  double tolerance = 0;      // lengths below it are rounding of the file, metres
  double most_left_out = 0;  // at rounded corners of outlines, metres
  double most_step = 0;      // by which sections may differ that one step stands for, metres
};

}  // namespace assay::mesh_import
