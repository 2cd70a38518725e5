#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/mesh_import/meshes/triangle_mesh.h"
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
  std::optional<Vector2> mouth = {};  // of a notch in a side: the outward normal of the side

  const Contour& At(bool top) const { return top ? at_high : at_low; }
};

struct Columns {
  std::vector<Column> columns;  // from low to high
  std::string reason;           // why the mesh is no stack; empty if it is
  int triangle = 0;             // index of a triangle that shows the reason
};

struct ColumnRules {
  double tolerance = 0;      // lengths below it are rounding of the file, metres
  double most_left_out = 0;  // at rounded corners of outlines, metres
};

// Cuts a closed mesh into columns. Levels are the heights at which facets lie across the axis or
// slant.
Columns ColumnsOf(const TriangleMesh& mesh, const ColumnRules& rules);

}  // namespace assay::mesh_import
