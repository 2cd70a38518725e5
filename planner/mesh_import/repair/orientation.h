#pragma once

#include "planner/mesh_import/meshes/triangle_mesh.h"

namespace assay::mesh_import {

// Turns triangles around so that neighbours run along their common edge in opposite directions.
// Only edges of two triangles connect neighbours. Returns how many triangles it turned. Throws
// InputError at a triangle of a surface with one side, such as a Moebius strip.
int OrientConsistently(TriangleMesh& mesh);

}  // namespace assay::mesh_import
