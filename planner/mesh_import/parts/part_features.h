#pragma once

#include "planner/mesh_import/parts/part_sketch.h"

namespace assay::mesh_import {

// Adds the features of a part to its sketch: first the exposed faces, then the holes that open to
// the outside, then the shafts. A shaft is a solid with free sides and a free tip: the whole part,
// or a solid that stands with its other end on other solids.
void AddFeatures(PartSketch& sketch);

}  // namespace assay::mesh_import
