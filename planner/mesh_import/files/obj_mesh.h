#pragma once

#include <string>
#include <string_view>

#include "planner/mesh_import/meshes/triangle_mesh.h"

namespace assay::mesh_import {

// Reads the surface in a Wavefront OBJ text, in the units of the file. Faces with more than three
// corners are split into triangles. `file` is its name for messages. Throws InputError with the
// line.
TriangleMesh ReadObjMesh(std::string_view text, const std::string& file);

}  // namespace assay::mesh_import
