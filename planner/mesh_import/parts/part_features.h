#pragma once

#include "planner/mesh_import/parts/part_sketch.h"

namespace assay::mesh_import {

// Adds the features of a part to its sketch: first the exposed faces, then the holes, then the
// shafts.
//
// A hole is a pocket that opens to the outside, or into wider pockets through which a shaft comes
// from outside: one layer of a counterbored hole.
//
// A shaft is a solid with free sides and a free rim around its tip. It is the whole part, or one
// layer of it. What stands on its tip is within its outline, so that all of this comes first into
// a hole that is as wide as the shaft.
void AddFeatures(PartSketch& sketch);

}  // namespace assay::mesh_import
