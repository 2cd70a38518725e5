#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "planner/mesh_import/meshes/triangle_mesh.h"

namespace assay::mesh_import {

// The surfaces of all nodes of a COLLADA file, in metres.
struct ColladaSurface {
  std::vector<Vector3> vertices;
  std::vector<std::array<int, 3>> triangles;
  std::string error;  // why the file cannot be read; empty if it can
};

// The module that reads COLLADA files (planner/assimp).
class ColladaLibrary {
 public:
  virtual ~ColladaLibrary() = default;
  virtual ColladaSurface Read(std::string_view text) const = 0;
};

// Reads the text of a COLLADA file (.dae). The unit of the file is converted to metres. The file's
// statement about which axis points up is ignored, as in ROS. Throws InputError if it cannot be
// read, and EnvironmentError if the module is missing.
TriangleMesh ReadCollada(std::string_view text, const std::string& file_name);

}  // namespace assay::mesh_import
