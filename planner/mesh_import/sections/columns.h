#pragma once

#include <string>
#include <vector>

#include "planner/mesh_import/meshes/triangle_mesh.h"
#include "planner/mesh_import/sections/column.h"

namespace assay::mesh_import {

struct Columns {
  std::vector<Column> columns;  // from low to high
  std::string reason;           // why the mesh is no stack; empty if it is
  int triangle = 0;             // index of a triangle that shows the reason
};

// Cuts a closed mesh into columns. Levels are the heights at which facets lie across the axis or
// slant.
Columns ColumnsOf(const TriangleMesh& mesh, const ColumnRules& rules);

// The columns between two neighbouring levels.
struct LayerColumns {
  std::vector<Column> columns;
  std::string reason;  // why the sections make none; empty if they do
};

// Pairs the curves of the sections at the two ends of a layer.
LayerColumns ColumnsOfLayer(std::vector<Column> bottom, std::vector<Column> top, double tolerance);

// Adds a column, or lengthens the column that it continues.
void Append(std::vector<Column>& columns, Column column, double tolerance);

}  // namespace assay::mesh_import
