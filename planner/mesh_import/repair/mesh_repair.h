#pragma once

#include <string>
#include <vector>

#include "planner/mesh_import/meshes/triangle_mesh.h"

namespace assay::mesh_import {

struct RepairedMesh {
  std::vector<TriangleMesh> bodies;  // closed, outward; the greatest volume first
  std::vector<std::string> repairs;  // what was done, one sentence each
};

// Makes closed bodies of a mesh in metres. It does only what cannot change the shape by more than
// rounding, and closes planar openings: it welds vertices, drops triangles of which two corners are
// now one vertex, orients triangles consistently and outward, and separates bodies that only touch.
// Throws InputError, with the triangle, for everything else.
RepairedMesh Repair(TriangleMesh mesh);

}  // namespace assay::mesh_import
