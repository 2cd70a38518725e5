#pragma once

#include <vector>

#include "planner/mesh_import/sections/column.h"

namespace assay::mesh_import {

// Gives the most material of their sections to those round steps that decide what fits: to the
// narrowest layer of a hole between wider ones, and to the widest layer of an outline between
// narrower ones. They are no steps then, and can be mated. A layer with a floor or a wider outline
// at one of its ends stays as it is.
void FillNarrows(std::vector<Column>& columns);

}  // namespace assay::mesh_import
