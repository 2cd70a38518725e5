#pragma once

#include "planner/mesh_import/meshes/triangle_mesh.h"

namespace assay::mesh_import {

struct Closing {
  int openings = 0;  // that were closed
  double area = 0;   // of what was added, in square metres
};

// Closes a consistently oriented mesh by triangles in the plane of each opening. Corners of an
// opening may be off its plane by `tolerance`, in metres. A slit without area, as between a long
// edge and the short edges of its neighbours, is an opening, too. Throws InputError at a triangle
// beside an opening that is not planar, or where triangles meet that do not bound a solid.
Closing CloseOpenings(TriangleMesh& mesh, double tolerance);

}  // namespace assay::mesh_import
