#pragma once

#include <string>
#include <string_view>

#include "planner/mesh_import/meshes/triangle_mesh.h"

namespace assay::mesh_import {

// Reads the vertices and faces of a Wavefront OBJ text, in the units of the file. Faces with more
// than three corners are split into triangles. Normals, textures, groups and materials are skipped.
// `file` is its name for messages. Throws InputError with the line.
TriangleMesh ReadObj(std::string_view text, const std::string& file);

}  // namespace assay::mesh_import
