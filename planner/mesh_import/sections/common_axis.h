#pragma once

#include <vector>

#include "planner/mesh_import/sections/column.h"

namespace assay::mesh_import {

// Gives one axis to the circles of columns whose centres are within `tolerance` of each other: that
// of the longest column. A leaning cone would otherwise leave slivers between itself and the
// cylinder beside it. An outline that is moved becomes larger by its way, and a hole smaller, so
// that a shaft is not thinner and a hole not wider than before.
void GiveCommonAxes(std::vector<Column>& columns, double tolerance);

}  // namespace assay::mesh_import
