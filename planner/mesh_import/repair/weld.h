#pragma once

#include "planner/mesh_import/meshes/triangle_mesh.h"

namespace assay::mesh_import {

// Makes vertices that are closer than `tolerance` (in the mesh's unit) one vertex, and drops
// triangles that thereby lose a side. Returns how many triangles it dropped.
int Weld(TriangleMesh& mesh, double tolerance);

}  // namespace assay::mesh_import
