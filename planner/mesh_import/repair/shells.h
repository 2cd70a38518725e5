#pragma once

#include <vector>

#include "planner/mesh_import/meshes/triangle_mesh.h"

namespace assay::mesh_import {

// Returns the connected parts of a closed mesh, in the order of their first triangles. Where four
// or more triangles share an edge, those belong together that have solid between them. Solids that
// only touch each other are therefore apart. Throws InputError for an edge with too many triangles.
std::vector<TriangleMesh> ShellsOf(const TriangleMesh& mesh);

}  // namespace assay::mesh_import
