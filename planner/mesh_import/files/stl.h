#pragma once

#include <string>
#include <string_view>

#include "planner/mesh_import/meshes/triangle_mesh.h"

namespace assay::mesh_import {

inline constexpr std::size_t kMostTriangles = 2'000'000;

// Reads STL, binary or as text, in the units of the file. `file` is its name for messages. A file
// is binary if its length fits the count in its head. Throws InputError with the line, or with the
// number of the triangle in a binary file.
TriangleMesh ReadStl(std::string_view text, const std::string& file);

}  // namespace assay::mesh_import
