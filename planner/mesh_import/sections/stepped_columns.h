#pragma once

#include "planner/mesh_import/sections/columns.h"

namespace assay::mesh_import {

// Cuts a closed mesh into columns where ColumnsOf cannot, because the section changes at many
// heights or changes its shape. There a straight column, a step, stands for sections that differ by
// at most ColumnRules::most_step, or that are at most so far apart along the axis. A step has the
// section with the least material. The columns therefore hardly reach beyond the mesh, and parts
// that are apart in their files stay apart. Holes and outlines that are the same in all sections of
// a step are no steps themselves. Nor are those of nearly even sections, which differ by at most a
// quarter of a step: they have the most material of these sections, so that a shaft is not thinner
// and a hole not wider than in the mesh. If such sections are nearly round, the column has the
// circle around them, or the circle within them if it is a hole.
Columns SteppedColumnsOf(const TriangleMesh& mesh, const ColumnRules& rules);

}  // namespace assay::mesh_import
